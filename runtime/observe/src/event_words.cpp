// SPDX-License-Identifier: Apache-2.0
#include "rave/observe/event_words.hpp"

#include <fmt/format.h>

#include "rave/observe/run_observer.hpp"

namespace rave::runtime {

std::string words_of(const BodyKinds& kinds, const sim::Event& event) {
  if (!event.other.valid() || is_of_obstacle(event.kind)) return event.text;
  const std::string with = fmt::format("with {}", kinds.name(event.other.value()));
  return event.text.empty() ? with : with + ' ' + event.text;
}

}  // namespace rave::runtime
