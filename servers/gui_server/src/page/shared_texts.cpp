// SPDX-License-Identifier: Apache-2.0
#include "page/shared_texts.hpp"

#include "page/page_text.hpp"

namespace rave::gui_server {
namespace {

/// `known`, if it is still there and of this revision; otherwise what `make` returns.
template <class Text, class Make>
web::Payload shared(Text& known, std::uint64_t revision, Make make) {
  web::Payload text = known.revision == revision ? known.payload.lock() : nullptr;
  if (text) return text;
  text = payload(make());
  known = {text, revision};
  return text;
}

}  // namespace

SharedTexts::Texts& SharedTexts::of(const std::shared_ptr<Source>& source) {
  std::erase_if(texts_, [](const auto& entry) { return entry.first.expired(); });
  return texts_[source];
}

web::Payload SharedTexts::scene(const std::shared_ptr<Source>& source) {
  return shared(of(source).scene, source->bodies_revision(), [&] {
    return R"({"type":"scene","hidden":)" + source->hidden_kinds_json() + R"(,"bodies":)" +
           source->bodies_json() + "}";
  });
}

web::Payload SharedTexts::roster(const std::shared_ptr<Source>& source) {
  // The robots of a source never change.
  return shared(of(source).roster, 0,
                [&] { return R"({"type":"roster","robots":)" + source->robots_json() + "}"; });
}

web::Payload SharedTexts::events(const std::shared_ptr<Source>& source) {
  return shared(of(source).events, source->events_revision(),
                [&] { return events_text(source->events(), 0); });
}

}  // namespace rave::gui_server
