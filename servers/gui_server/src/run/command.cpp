// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/command.hpp"

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

request::Action CommandMessage::action_for(std::size_t i) const {
  request::Action one = action;
  if (points.empty()) return one;
  if (auto* const goal = std::get_if<request::Goal>(&one)) goal->p_W = points[i];
  if (auto* const place = std::get_if<request::Place>(&one)) place->p_W = points[i];
  return one;
}

void Source::command(const CommandMessage& command, const Author& /*author*/,
                     const SlotReply& reply) {
  const char* const why_not = "This is a recording: it takes no orders.";
  if (command.slots.empty()) reply(kNoSlot, false, why_not);
  for (const std::uint32_t slot : command.slots) reply(slot, false, why_not);
}

Result<ProbeMade> Source::probe(const ProbeRequest& /*request*/) {
  return fail(ErrorCode::kState, "This is a recording: no virtual sensors can be tried in it.");
}

}  // namespace rave::gui_server
