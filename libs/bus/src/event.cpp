// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/event.hpp"

#include <fmt/format.h>

#include "rave/base/word_table.hpp"

namespace rave::bus {
namespace {

constexpr WordTable<EventKind, 11> kKinds = {{
    {"participant appeared", EventKind::kParticipantAppeared},
    {"participant lost", EventKind::kParticipantLost},
    {"writer appeared", EventKind::kWriterAppeared},
    {"writer lost", EventKind::kWriterLost},
    {"reader appeared", EventKind::kReaderAppeared},
    {"reader lost", EventKind::kReaderLost},
    {"incompatible", EventKind::kIncompatible},
    {"foreign run", EventKind::kForeignRun},
    {"refused", EventKind::kRefused},
    {"notice", EventKind::kNotice},
    {"stood still", EventKind::kStoodStill},
}};

}  // namespace

std::string_view to_string(EventKind kind) noexcept { return kKinds.of(kind, "unknown"); }

std::string BusEvent::line() const {
  std::string line(to_string(kind));
  if (!topic.empty()) line += fmt::format(" on {}", topic);
  if (!participant.empty()) line += fmt::format(": {}", participant);
  if (writer != 0) line += fmt::format(" ({:016x})", writer);
  if (!text.empty()) line += fmt::format(": {}", text);
  return line;
}

}  // namespace rave::bus
