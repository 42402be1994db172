// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/bus/topics.hpp"
#include "rave/protocol/live_world.hpp"
#include "rave/protocol/robot_columns.hpp"

namespace rave::real_time {

using lock_step::RobotColumns;

/// The robot at a place of a message, which has passed bus::validate(). `shift` is put on its
/// stamp.
[[nodiscard]] RobotSight read_robot(const rave_wire_PlanarRobots& robots, std::size_t index,
                                    Duration shift);

/// How an obstacle stands, as the bus carries it. Errors: kInvalidArgument, see
/// lock_step::read_obstacle(). The sample has passed bus::validate().
[[nodiscard]] Result<ObstacleSight> read_obstacle(const bus::Obstacle& sample);

/// A message of a robot as a packet that borrows `bytes`; `shift` is put on its stamp.
[[nodiscard]] bus::Packet packet_of(const sim::SentPacket& sent, std::span<const std::byte> bytes,
                                    std::uint64_t number, Duration shift);
/// And back; its bytes are those of the payload, and it left its robot when it was sent. The packet
/// has passed bus::validate().
[[nodiscard]] sim::SentPacket read_packet(const bus::Packet& packet, Duration shift);
[[nodiscard]] std::span<const std::byte> payload_of(const bus::Packet& packet) noexcept;

}  // namespace rave::real_time
