// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "rave/base/ids.hpp"
#include "rave/plugin/param_set.hpp"
#include "rave/robot/communicator.hpp"
#include "rave/robot/transmitter.hpp"

namespace rave::sim {

/// What carries messages out of the robots of a type.
struct TransmitterSpec {
  std::string name;
  std::string driver;
  const TransmitterOps* ops = nullptr;
  plugin::ParamSet params;
};

/// Through which the program of a type of robot talks.
struct CommunicatorSpec {
  std::string name;
  std::string driver;
  const CommunicatorOps* ops = nullptr;
  plugin::ParamSet params;
  std::uint32_t transmitter = 0;  ///< Index into RobotType::transmitters.
};

/// What became of all messages of a run. Of those that robots of this host sent to one another
///
///     offered = sent + lost_queue + lost_device + waiting
///     addressed = delivered + lost_range + lost_obstacle + lost_chance + lost_mailbox + under way
///
/// hold at any time; a message to everyone is addressed to each other robot with that communicator.
struct RadioCounts {
  std::uint64_t offered = 0;      ///< Messages that programs gave.
  std::uint64_t refused = 0;      ///< ... and those that they could not, for want of room.
  std::uint64_t sent = 0;         ///< Left their robot completely.
  std::uint64_t lost_queue = 0;   ///< The sender's queue was full.
  std::uint64_t lost_device = 0;  ///< A transmitter did not take them.
  std::uint64_t addressed = 0;    ///< Pairs of a sent message and a robot that it is for.
  std::uint64_t delivered = 0;
  std::uint64_t lost_range = 0;
  std::uint64_t lost_obstacle = 0;
  std::uint64_t lost_chance = 0;
  std::uint64_t lost_mailbox = 0;
  // Packets that came in through devices:
  std::uint64_t heard = 0;     ///< For a robot of this host, whole and new; part of `addressed`.
  std::uint64_t foreign = 0;   ///< Of another network, for others, or the sender's own echo.
  std::uint64_t repeated = 0;  ///< Had come before.
  std::uint64_t garbled = 0;   ///< No packet, or its checksum is wrong.
  std::uint64_t overrun = 0;   ///< Came faster than steps took them.

  RadioCounts& operator+=(const RadioCounts& other) noexcept;
  friend bool operator==(const RadioCounts&, const RadioCounts&) = default;
};

/// One message in one step, for observers and records: sent, or delivered to one robot. A view into
/// the engine.
struct RadioTrace {
  RobotId from;              ///< May be a number beyond the robots, see MessageHead::from.
  RobotId to;                ///< None for `sent`.
  std::uint32_t device = 0;  ///< Index of the communicator: of the receiver, for `sent` the sender.
  bool delivered = false;
  std::uint32_t sequence = 0;
  std::int64_t stamp_ns = 0;     ///< As in MessageHead.
  std::int64_t complete_ns = 0;  ///< Sent: when the last byte had left. Delivered: now.
  std::span<const std::byte> payload;
};

}  // namespace rave::sim
