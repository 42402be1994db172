// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "rave/base/ids.hpp"
#include "rave/robot/communicator.hpp"
#include "rave/robot/transmitter.hpp"
#include "rave/sim/driver_spec.hpp"

namespace rave::sim {

/// A transmitter of a robot type: the device that carries its messages.
struct TransmitterSpec : DriverSpec {
  const TransmitterOps* ops = nullptr;
};

/// A communicator of a robot type: the channel through which its program sends and receives.
struct CommunicatorSpec : DriverSpec {
  const CommunicatorOps* ops = nullptr;
  std::uint32_t transmitter = 0;  ///< Index into RobotType::transmitters.
};

/// Counts of all messages of a run. For messages between robots of this host
///
///     offered = sent + lost_queue + lost_device + waiting
///     addressed = delivered + lost_range + lost_obstacle + lost_chance + lost_mailbox + in transit
///
/// hold at any time. A message to everyone is addressed to each other robot with that
/// communicator.
struct RadioCounts {
  std::uint64_t offered = 0;      ///< Messages that programs sent.
  std::uint64_t refused = 0;      ///< Messages refused for lack of room.
  std::uint64_t sent = 0;         ///< Messages that left their robot completely.
  std::uint64_t lost_queue = 0;   ///< The sender's queue was full.
  std::uint64_t lost_device = 0;  ///< Refused by the transmitter.
  std::uint64_t addressed = 0;    ///< Pairs of a sent message and a robot it is addressed to.
  std::uint64_t delivered = 0;
  std::uint64_t lost_range = 0;
  std::uint64_t lost_obstacle = 0;
  std::uint64_t lost_chance = 0;
  std::uint64_t lost_mailbox = 0;
  // Packets received through devices:
  std::uint64_t heard = 0;  ///< Valid, new, for a robot of this host; part of `addressed`.
  /// Of another network, for other robots, or an echo of the sender's own.
  std::uint64_t foreign = 0;
  std::uint64_t repeated = 0;  ///< Duplicates.
  std::uint64_t garbled = 0;   ///< Not a packet, or with a wrong checksum.
  std::uint64_t overrun = 0;   ///< Lost because they arrived faster than steps read them.

  RadioCounts& operator+=(const RadioCounts& other) noexcept;
  friend bool operator==(const RadioCounts&, const RadioCounts&) = default;
};

/// One message in one step, for observers and recordings: sent, or delivered to one robot. A view
/// into the engine.
struct RadioTrace {
  RobotId from;  ///< May be a number beyond the robots, see MessageHead::from.
  RobotId to;    ///< None for `sent`.
  /// Index of the communicator: the receiver's, for `sent` the sender's.
  std::uint32_t device = 0;
  bool delivered = false;
  std::uint32_t sequence = 0;
  std::int64_t stamp_ns = 0;     ///< As in MessageHead.
  std::int64_t complete_ns = 0;  ///< Sent: time at which the last byte left. Delivered: now.
  std::span<const std::byte> payload;
};

}  // namespace rave::sim
