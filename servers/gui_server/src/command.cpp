// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/command.hpp"

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

std::string_view to_string(CommandMessage::Kind kind) noexcept {
  switch (kind) {
    case CommandMessage::Kind::kDrive:
      return "drive";
    case CommandMessage::Kind::kGoal:
      return "goal";
    case CommandMessage::Kind::kPath:
      return "path";
    case CommandMessage::Kind::kCancel:
      return "cancel";
    case CommandMessage::Kind::kText:
      return "text";
    case CommandMessage::Kind::kPlace:
      return "place";
    case CommandMessage::Kind::kTake:
      return "take";
    case CommandMessage::Kind::kGive:
      return "give";
    case CommandMessage::Kind::kSet:
      return "set";
    case CommandMessage::Kind::kEdit:
      return "edit";
    case CommandMessage::Kind::kHandOver:
      return "hand_over";
    case CommandMessage::Kind::kResetShadow:
      return "reset_shadow";
  }
  return "";
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
