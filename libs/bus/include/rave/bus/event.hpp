// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rave::bus {

enum class EventKind : std::uint8_t {
  kParticipantAppeared,
  kParticipantLost,  ///< It left, or was silent for longer than its lease.
  kWriterAppeared,   ///< Of a topic that this process reads.
  kWriterLost,
  kReaderAppeared,  ///< Of a topic that this process writes.
  kReaderLost,
  kIncompatible,  ///< Somebody is at the same topic and gets nothing; the text says how to mend it.
  kForeignRun,    ///< A process or sample of another run came by and was ignored.
  kRefused,       ///< A sample did not pass validation; the text says why.
  kNotice,        ///< Cyclone DDS has something to say, mostly a warning.
  kStoodStill,    ///< This process did, for so long that others may be missed; see Standstill.
};

/// The lower-case name of a kind, for logs.
[[nodiscard]] std::string_view to_string(EventKind kind) noexcept;

/// Something that changed on the bus. A value.
struct BusEvent {
  EventKind kind{};
  /// The topic it is about; empty for participants.
  std::string topic;
  /// The other side's participant name; empty if it has none.
  std::string participant;
  /// The other side's writer id; 0 if it is no process of RAVE.
  std::uint64_t writer = 0;
  std::string text;

  /// One line for a log.
  [[nodiscard]] std::string line() const;
};

}  // namespace rave::bus
