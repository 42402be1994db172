// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/event.hpp"

#include <fmt/format.h>

namespace rave::bus {

std::string_view to_string(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::kParticipantAppeared:
      return "participant appeared";
    case EventKind::kParticipantLost:
      return "participant lost";
    case EventKind::kWriterAppeared:
      return "writer appeared";
    case EventKind::kWriterLost:
      return "writer lost";
    case EventKind::kReaderAppeared:
      return "reader appeared";
    case EventKind::kReaderLost:
      return "reader lost";
    case EventKind::kIncompatible:
      return "incompatible";
    case EventKind::kForeignRun:
      return "foreign run";
    case EventKind::kRefused:
      return "refused";
    case EventKind::kNotice:
      return "notice";
    case EventKind::kStoodStill:
      return "stood still";
  }
  return "unknown";
}

std::string BusEvent::line() const {
  std::string line(to_string(kind));
  if (!topic.empty()) line += fmt::format(" on {}", topic);
  if (!participant.empty()) line += fmt::format(": {}", participant);
  if (writer != 0) line += fmt::format(" ({:016x})", writer);
  if (!text.empty()) line += fmt::format(": {}", text);
  return line;
}

}  // namespace rave::bus
