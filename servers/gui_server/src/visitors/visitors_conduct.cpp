// SPDX-License-Identifier: Apache-2.0
// What people ask about runs as such, and what they learn of them.
#include "page/conduct_message.hpp"
#include "visitors/visitors.hpp"

namespace rave::gui_server {
namespace {

bool may_conduct(const View& view) { return view.may_all(InfoClass::kConduct); }

}  // namespace

void Visitors::conduct_by(std::shared_ptr<Conductor> conductor) {
  conductor_ = std::move(conductor);
  for (auto& [id, visitor] : visitors_) {
    if (visitor.view) show_to(visitor, true);
  }
  tell_conduct();
}

bool Visitors::conducts_runs(const Visitor& visitor) const {
  return conductor_ && visitor.view && may_conduct(*visitor.view);
}

void Visitors::take_conduct(std::uint64_t id, const ConductMessage& message) {
  Visitor& visitor = visitors_.at(id);
  const std::string word(word_of(message.what));
  Result<std::string> done = fail(ErrorCode::kState, "This page can neither start nor end runs.");
  if (conductor_ && !conducts_runs(visitor)) {
    done = fail(ErrorCode::kState, "Your rights do not include this.");
  } else if (conductor_) {
    done = conductor_->take(message);
  }
  const std::string detail = message.name.empty() ? word : word + " " + message.name;
  if (done) {
    audit_->note("conduct", {{"user", visitor.person.name}, {"detail", detail}});
  } else {
    audit_->note("refused",
                 {{"why", "conduct"}, {"user", visitor.person.name}, {"detail", detail}});
  }
  visitor.page->send(payload(answer_text(
      {word, done.has_value(), done ? *done : done.error().message, message.request, {}})));
  tell_conduct();
}

void Visitors::tell_conduct() {
  if (!conductor_ || !source_) return;
  // Before the texts, so that the next call sends a change between the two.
  const std::uint64_t revision = conductor_->revision();
  web::Payload whole;
  web::Payload part;
  for (auto& [id, visitor] : visitors_) {
    if (visitor.told_conduct == revision || !visitor.view) continue;
    visitor.told_conduct = revision;
    const bool all = conducts_runs(visitor);
    web::Payload& text = all ? whole : part;
    if (!text) text = payload(conductor_->text(all));
    visitor.page->send(text);
  }
}

}  // namespace rave::gui_server
