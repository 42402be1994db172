// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/protocol/step_messages.hpp"

/// The parts that reports and worlds have in common: columns, poses, samples, packets, sizes.
namespace rave::lock_step {

/// Columns are sent as they are in memory; the message refers to them without copying and only
/// reads them.
template <class Sequence, class T>
void lend(Sequence& sequence, const std::vector<T>& values) {
  bus::borrow(sequence, const_cast<std::vector<T>&>(values));
}

template <class Sequence>
void lend_bytes(Sequence& sequence, std::span<const std::byte> bytes) {
  sequence._buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(bytes.data()));
  sequence._length = static_cast<std::uint32_t>(bytes.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

template <class Sequence, class T>
void take(const Sequence& sequence, std::vector<T>& values) {
  const auto all = bus::elements(sequence);
  values.assign(all.begin(), all.end());
}

inline rave_wire_PoseReport to_wire(const sim::PoseReport& report) {
  const sim::ReportedPose& reported = report.reported;
  const PoseReading& pose = reported.pose;
  return {report.robot.value(),
          reported.known,
          reported.stale,
          pose.x_m,
          pose.y_m,
          pose.yaw_rad,
          pose.variance_xy_m2,
          pose.variance_yaw_rad2,
          reported.velocity.vx,
          reported.velocity.vy,
          reported.velocity.wz,
          reported.stamp.ns};
}

inline sim::PoseReport from_wire(const rave_wire_PoseReport& wire) {
  sim::PoseReport report;
  report.robot = RobotId(wire.robot);
  report.reported = {
      {wire.x_m, wire.y_m, wire.yaw_rad, wire.variance_xy_m2, wire.variance_yaw_rad2},
      {wire.vx_mps, wire.vy_mps, wire.wz_radps},
      SimTime{wire.stamp_ns},
      wire.known,
      wire.stale};
  return report;
}

inline rave_wire_PoseSample to_wire(const sim::PoseSample& sample) {
  return {sample.robot.value(), sample.stamp.ns, sample.X_WR.x, sample.X_WR.y, sample.X_WR.yaw};
}

inline sim::PoseSample from_wire(const rave_wire_PoseSample& wire) {
  return {RobotId(wire.robot), SimTime{wire.stamp_ns}, {wire.x_m, wire.y_m, wire.yaw_rad}};
}

inline rave_wire_SentPacket to_wire(const sim::SentPacket& packet) {
  return {packet.robot.value(),
          packet.communicator,
          packet.sequence,
          static_cast<std::uint32_t>(packet.to.kind),
          packet.to.robot,
          packet.stamp_ns,
          packet.complete_ns,
          packet.x_m,
          packet.y_m,
          packet.range_m,
          packet.antenna_z_m,
          packet.located != 0,
          packet.line_of_sight != 0,
          packet.first_byte,
          packet.size};
}

inline sim::SentPacket from_wire(const rave_wire_SentPacket& wire) {
  sim::SentPacket packet;
  packet.robot = RobotId(wire.robot);
  packet.communicator = wire.communicator;
  packet.sequence = wire.number;
  packet.to = {static_cast<RecipientKind>(wire.to_kind), wire.to_robot};
  packet.stamp_ns = wire.stamp_ns;
  packet.complete_ns = wire.complete_ns;
  packet.x_m = wire.x_m;
  packet.y_m = wire.y_m;
  packet.range_m = wire.range_m;
  packet.antenna_z_m = wire.antenna_z_m;
  packet.located = wire.located ? 1 : 0;
  packet.line_of_sight = wire.line_of_sight ? 1 : 0;
  packet.first_byte = wire.first_byte;
  packet.size = wire.size;
  return packet;
}

/// Converts all elements of a vector, in either direction.
template <class From, class To>
void all_to_wire(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& one : from) to.push_back(to_wire(one));
}

template <class Sequence, class To>
void all_from_wire(const Sequence& sequence, std::vector<To>& to) {
  to.clear();
  for (const auto& one : bus::elements(sequence)) to.push_back(from_wire(one));
}

/// Fills the parts common to reports and worlds: poses, samples and messages.
template <class Message, class Plain>
void fill_parts(const Plain& plain, WireParts& parts, Message& message) {
  all_to_wire(plain.poses, parts.poses);
  bus::borrow(message.poses, parts.poses);
  all_to_wire(plain.samples, parts.samples);
  bus::borrow(message.samples, parts.samples);
  all_to_wire(plain.sent.packets, parts.packets);
  bus::borrow(message.sent.packets, parts.packets);
  lend_bytes(message.sent.bytes, plain.sent.bytes);
}

template <class Message, class Plain>
void read_parts(const Message& message, Plain& plain) {
  all_from_wire(message.poses, plain.poses);
  all_from_wire(message.samples, plain.samples);
  all_from_wire(message.sent.packets, plain.sent.packets);
  const auto bytes = std::as_bytes(bus::elements(message.sent.bytes));
  plain.sent.bytes.assign(bytes.begin(), bytes.end());
}

template <class Sequence>
void fill_sizes(const std::vector<sim::ResizedRobot>& robots,
                std::vector<rave_wire_ResizedRobot>& wire, Sequence& sequence) {
  wire.clear();
  for (const sim::ResizedRobot& robot : robots) {
    auto& one = wire.emplace_back();
    one.robot = robot.robot.value();
    one.scale = robot.scale;
    bus::put_text(one.author, robot.by);
  }
  bus::borrow(sequence, wire);
}

template <class Sequence>
void read_sizes(const Sequence& sequence, std::vector<sim::ResizedRobot>& robots) {
  for (const auto& robot : bus::elements(sequence)) {
    robots.push_back({RobotId(robot.robot), robot.scale, robot.author});
  }
}

}  // namespace rave::lock_step
