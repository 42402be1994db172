// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/bus/topics.hpp"
#include "rave/protocol/live_world.hpp"
#include "rave/protocol/robot_columns.hpp"

namespace rave::real_time {

using lock_step::RobotColumns;

/// Decodes the robot at an index of a message that has passed bus::validate(). `shift` is added to
/// its stamp.
[[nodiscard]] RobotSight read_robot(const rave_wire_PlanarRobots& robots, std::size_t index,
                                    Duration shift);

/// Decodes an obstacle of a sample that has passed bus::validate(). Errors: kInvalidArgument, see
/// lock_step::read_obstacle().
[[nodiscard]] Result<ObstacleSight> read_obstacle(const bus::Obstacle& sample);

/// Encodes a message of a robot; the packet borrows `bytes`. `shift` is added to its stamp.
[[nodiscard]] bus::Packet packet_of(const sim::SentPacket& sent, std::span<const std::byte> bytes,
                                    std::uint64_t number, Duration shift);
/// The inverse of packet_of(), without the payload. The message counts as complete at its stamp.
/// The packet must have passed bus::validate().
[[nodiscard]] sim::SentPacket read_packet(const bus::Packet& packet, Duration shift);
[[nodiscard]] std::span<const std::byte> payload_of(const bus::Packet& packet) noexcept;

}  // namespace rave::real_time
