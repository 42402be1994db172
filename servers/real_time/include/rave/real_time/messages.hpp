// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/bus/topics.hpp"
#include "rave/real_time/live_world.hpp"

namespace rave::real_time {

/// Robots in the plane, in the columns that a message borrows. One owner thread.
class RobotColumns {
 public:
  void clear() noexcept;
  /// Behind those with lower numbers. Stamps by the clock of the run.
  void add(const RobotSight& sight);
  /// The message holds until this object changes.
  void lend(rave_wire_PlanarRobots& robots) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return id_.size(); }

 private:
  std::vector<std::uint32_t> id_;
  std::vector<double> x_m_, y_m_, yaw_rad_, vx_mps_, vy_mps_, wz_radps_;
  std::vector<std::int64_t> stamp_ns_;
};

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
