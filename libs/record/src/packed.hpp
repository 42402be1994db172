// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Elements of the exact streams, with equal layout in memory and, by CDR, in the message. Their
// arrays begin at a multiple of 8, because the preceding members are chosen so.
namespace rave::record {

/// Increased with changes of these layouts. 2: rows of robots.
inline constexpr std::uint32_t kLayoutVersion = 2;

/// rave_msgs/msg/RobotPose
struct PackedPose {
  std::uint32_t robot;
  std::uint32_t flags;
  double x, y, yaw;
  double vx, vy, wz;
};
static_assert(sizeof(PackedPose) == 56);

/// rave_msgs/msg/TruePose
struct PackedTruePose {
  std::uint32_t robot;
  std::uint32_t reserved;
  double x, y, yaw;
};
static_assert(sizeof(PackedTruePose) == 32);

inline constexpr std::uint32_t kHasReported = 1;
inline constexpr std::uint32_t kHasTrue = 2;
/// The true pose has the same bits as the reported one and is not repeated.
inline constexpr std::uint32_t kTrueIsReported = 4;

/// rave_msgs/msg/Percept. In a row of robots (`robots` above 1) all have this header and equal
/// parts of the bytes.
struct PackedPercept {
  std::uint32_t robot;
  std::uint16_t sensor;
  std::uint8_t kind;
  std::uint8_t part;
  std::int64_t stamp_ns;
  std::uint32_t sequence;
  std::uint32_t count;
  std::uint32_t fresh;
  std::uint32_t dropped;
  std::uint32_t offset;
  std::uint32_t size;
  std::uint32_t robots;
  std::uint32_t reserved;
};
static_assert(sizeof(PackedPercept) == 48);

/// rave_msgs/msg/Command. A row of robots divides the bytes equally.
struct PackedCommand {
  std::uint32_t robot;
  std::uint32_t controller;
  std::uint32_t offset;
  std::uint32_t size;
  std::uint32_t robots;
  std::uint32_t reserved;
};
static_assert(sizeof(PackedCommand) == 24);

/// rave_msgs/msg/ActuatorCommand
struct PackedActuator {
  std::uint32_t robot;
  std::uint32_t actuator;
  std::uint32_t offset;
  std::uint32_t size;
};
static_assert(sizeof(PackedActuator) == 16);

/// rave_msgs/msg/Packet
struct PackedPacket {
  std::int64_t sent_ns;
  std::int64_t received_ns;
  std::uint32_t from;
  std::uint32_t to;
  std::uint16_t transmitter;
  std::uint16_t delivered;
  std::uint32_t offset;
  std::uint32_t size;
  std::uint32_t reserved;
};
static_assert(sizeof(PackedPacket) == 40);

}  // namespace rave::record
