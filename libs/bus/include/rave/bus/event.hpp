// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rave::bus {

enum class EventKind : std::uint8_t {
  kParticipantAppeared,
  kParticipantLost,  ///< It left, or was silent for longer than its lease.
  kWriterAppeared,   ///< On a topic that this process reads.
  kWriterLost,
  kReaderAppeared,  ///< On a topic that this process writes.
  kReaderLost,
  kIncompatible,  ///< An entity on the same topic has incompatible QoS and receives nothing; the
                  ///< text says how to correct it.
  kForeignRun,    ///< A process or sample of another run was seen and ignored.
  kRefused,       ///< A sample failed validation; the text gives the reason.
  kNotice,        ///< A log line of Cyclone DDS, usually a warning.
  kStoodStill,    ///< This process was unable to run for so long that lost processes may be missed;
                  ///< see Standstill.
};

/// The lower-case name of a kind, for logs.
[[nodiscard]] std::string_view to_string(EventKind kind) noexcept;

/// A change on the bus. A value.
struct BusEvent {
  EventKind kind{};
  /// The topic concerned; empty for participants.
  std::string topic;
  /// The participant name of the other process; empty if it has none.
  std::string participant;
  /// The writer id of the other process; 0 if it is not a process of RAVE.
  std::uint64_t writer = 0;
  std::string text;

  /// The event as one log line.
  [[nodiscard]] std::string line() const;
};

}  // namespace rave::bus
