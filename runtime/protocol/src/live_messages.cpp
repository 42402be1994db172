// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/live_messages.hpp"

#include "rave/bus/sequence.hpp"
#include "rave/math/transform.hpp"
#include "rave/protocol/obstacle_messages.hpp"
#include "step_parts.hpp"

namespace rave::real_time {

RobotSight read_robot(const rave_wire_PlanarRobots& robots, std::size_t index, Duration shift) {
  RobotSight sight;
  sight.robot = RobotId(bus::elements(robots.id)[index]);
  sight.stamp = SimTime{bus::elements(robots.stamp_ns)[index]} + shift;
  sight.X_WR = {bus::elements(robots.x_m)[index], bus::elements(robots.y_m)[index],
                wrap_angle(bus::elements(robots.yaw_rad)[index])};
  // On the wire velocities are in the world frame, for readers that know no robot frame. Engines
  // use the body frame.
  const Vec2 v_W{bus::elements(robots.vx_mps)[index], bus::elements(robots.vy_mps)[index]};
  const Vec2 v_B = rotate(-sight.X_WR.yaw, v_W);
  sight.velocity = {v_B.x, v_B.y, bus::elements(robots.wz_radps)[index]};
  return sight;
}

Result<ObstacleSight> read_obstacle(const bus::Obstacle& sample) {
  ObstacleSight sight;
  sight.revision = sample.revision;
  sight.scheduled = sample.scheduled;
  sight.removed = sample.removed;
  RAVE_TRY_ASSIGN(sight.stands, lock_step::read_obstacle(sample.stands));
  return sight;
}

bus::Packet packet_of(const sim::SentPacket& sent, std::span<const std::byte> bytes,
                      std::uint64_t number, Duration shift) {
  bus::Packet packet{};
  packet.number = number;
  packet.from_robot = sent.robot.value();
  packet.communicator = sent.communicator;
  packet.sequence_number = sent.sequence;
  packet.to_kind = static_cast<rave_wire_RecipientKind>(sent.to.kind);
  packet.to_robot = sent.to.robot;
  packet.sent_ns = sent.stamp_ns + shift.ns;
  packet.x_m = sent.x_m;
  packet.y_m = sent.y_m;
  packet.range_m = sent.range_m;
  packet.antenna_z_m = sent.antenna_z_m;
  packet.located = sent.located != 0;
  packet.line_of_sight = sent.line_of_sight != 0;
  // Cyclone DDS does not write to samples that it sends.
  // The payload is lent, not copied: `bytes` must live until the packet has been written.
  lock_step::lend_bytes(packet.payload, bytes);
  return packet;
}

sim::SentPacket read_packet(const bus::Packet& packet, Duration shift) {
  sim::SentPacket sent;
  sent.robot = RobotId(packet.from_robot);
  sent.communicator = packet.communicator;
  sent.sequence = packet.sequence_number;
  sent.to = {static_cast<RecipientKind>(packet.to_kind), packet.to_robot};
  sent.stamp_ns = packet.sent_ns + shift.ns;
  // When the transmission was complete is not on the wire. LiveWorld replaces it by the step in
  // which the packet counts.
  sent.complete_ns = sent.stamp_ns;
  sent.x_m = packet.x_m;
  sent.y_m = packet.y_m;
  sent.range_m = packet.range_m;
  sent.antenna_z_m = packet.antenna_z_m;
  sent.located = packet.located ? 1 : 0;
  sent.line_of_sight = packet.line_of_sight ? 1 : 0;
  return sent;
}

std::span<const std::byte> payload_of(const bus::Packet& packet) noexcept {
  return std::as_bytes(bus::elements(packet.payload));
}

}  // namespace rave::real_time
