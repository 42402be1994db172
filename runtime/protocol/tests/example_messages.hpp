// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "rave/sim/host_report.hpp"
#include "rave/sim/world_authority.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::lock_step::testing {

/// Messages in which every field has a value of its own.
inline sim::PoseReport example_pose(std::uint32_t robot) {
  const double k = robot;
  sim::PoseReport report;
  report.robot = RobotId(robot);
  report.reported = {
      {k + 0.1, k + 0.2, 0.3, 0.04, 0.05}, {0.6, -0.7, 0.8}, SimTime{900}, true, robot % 2 == 1};
  return report;
}

inline void add_packets(sim::SentPackets& sent) {
  for (std::uint32_t i = 0; i < 2; ++i) {
    sim::SentPacket packet;
    packet.robot = RobotId(i + 1);
    packet.communicator = 1;
    packet.sequence = 7 + i;
    packet.to = i == 0 ? Recipient::team() : Recipient::one(2);
    packet.stamp_ns = 10;
    packet.complete_ns = 20;
    packet.x_m = 1.5;
    packet.y_m = -2.5;
    packet.range_m = 4;
    packet.antenna_z_m = 0.3;
    packet.located = 1;
    packet.line_of_sight = static_cast<std::uint8_t>(i);
    const std::vector<std::byte> bytes(3 + i, std::byte{0x5a});
    sent.add(packet, bytes);
  }
}

inline std::vector<sim::WorldInput> example_orders() {
  sim::WorldInput path;
  path.sequence = 6;
  path.author.name = "anna";
  path.robot = RobotId(0);
  path.action = request::Order(request::Path{{{1, 2}, {-3.5, 1e-3}}, 0.125});
  sim::WorldInput words;
  words.sequence = 7;
  words.robot = RobotId(2);
  words.action = request::Order(request::Text{"hello"});
  sim::WorldInput drive;
  drive.sequence = 8;
  drive.robot = RobotId(2);
  drive.action = request::Order(request::Drive{-0.5, 1.5});
  sim::WorldInput goal;
  goal.sequence = 9;
  goal.robot = RobotId(0);
  goal.action = request::Order(request::Goal{{1e-300, 2}, 0.75, 0.25});
  return {path, words, drive, goal};
}

inline sim::HostReport example_report() {
  sim::HostReport report;
  report.host = 2;
  report.begin(41);
  report.state = sim::HostState::kDone;
  report.text = "all is said";
  report.proposals = {{1, 2, 5}, {0.1, 0.2, 0.3}, {0, -1, 1e-300}, {3, 2, 1}};
  add_packets(report.sent);
  report.poses = {example_pose(2), example_pose(5)};
  report.samples = {{RobotId(5), SimTime{800}, {1, 2, 3}}, {RobotId(5), SimTime{900}, {4, 5, 6}}};
  report.refusals = {{3, "there is no such parameter"}};
  report.inputs = example_orders();
  return report;
}

inline std::vector<sim::WorldInput> example_inputs() {
  sim::WorldInput stop;
  stop.sequence = 4;
  sim::WorldInput change;
  change.sequence = 5;
  change.author = sim::Author::kRun;
  change.robot = RobotId(1);
  using Part = sim::ParameterChange::Part;
  change.action = sim::Change{{{Part::kProgram, 0, "speed_mps", 0.4},
                               {Part::kController, 1, "mode", std::string("fast")},
                               {Part::kActuator, 2, "gains", std::vector<double>{1, 2, 3}}}};
  std::vector<sim::WorldInput> inputs = {stop, change};
  const auto orders = example_orders();
  inputs.insert(inputs.end(), orders.begin(), orders.end());
  return inputs;
}

inline std::vector<sim::ObstacleChange> example_obstacles() {
  sim::ObstacleChange crate;
  crate.id = BodyId(9);
  crate.name = "crate";
  crate.X_WB = {1, -2, 0.5};
  crate.asked = R"({"remove_obstacle": "crate"})";
  crate.by = "anna";
  crate.body.name = crate.name;
  crate.body.colour = "#102030";
  crate.body.code = 7;
  crate.body.shapes = {*world::make_disc({0.1, 0.2}, 0.3, 0, 1)};
  const std::vector<Vec2> corners = {{0, 0}, {1, 0}, {0.25, 0.5}};
  crate.body.shapes.push_back(world::make_prisms(corners, 0.1, 0.9)->front());
  sim::ObstacleChange gone;
  gone.kind = sim::ObstacleChange::Kind::kRemove;
  gone.id = BodyId(8);
  gone.name = "post";
  return {crate, gone};
}

inline sim::WorldStep example_world() {
  sim::WorldStep world;
  world.begin(41, 3);
  world.last = true;
  world.x_m = {1, 2, 3};
  world.y_m = {-1, -2, -3};
  world.yaw_rad = {0.1, 0.2, 0.3};
  world.vx_mps = {0.5, 0.6, 0.7};
  world.vy_mps = {0, 0, -0.0};
  world.wz_radps = {1, -1, 0.25};
  world.flags = {3, 1, 0};
  world.pushed = {{RobotId(1), {7, 8, 9}}};
  world.touches = {{RobotId(2), {0.6, -0.8}}};
  world.poses = {example_pose(0), example_pose(1)};
  world.samples = {{RobotId(1), SimTime{700}, {1, 2, 3}}};
  world.resized = {{RobotId(2), 1.5, "bert"}};
  add_packets(world.sent);
  world.inputs = example_inputs();
  world.obstacles = example_obstacles();
  world.answers = {{2, 1'700'000'000'000'000'001, 6}, {2, 9, 7}};
  world.refusals = {{7, "there is no room"}};
  return world;
}

inline sim::AuthorityState example_authority() {
  sim::AuthorityState state;
  state.hash = RunHash::of_value(0xfedcba9876543210);
  state.events = {{41, RobotId(1), sim::EventKind::kContact, BodyId(9), "", 0}};
  state.pinned = {RobotId(0), RobotId(2)};
  state.scales = {{RobotId(2), 1.5}};
  state.inputs = 5;
  state.events.push_back({41, RobotId(), sim::EventKind::kObstacleRemoved, BodyId(8), "", 0});
  state.obstacle_changes = 6;
  sim::ObstacleChange moved;
  moved.kind = sim::ObstacleChange::Kind::kMove;
  moved.id = BodyId(0);
  moved.name = "door";
  moved.X_WB = {4, 5, -0.25};
  state.obstacles = {moved};
  state.refused_count = 3;
  state.refused = {{7, RobotId(2), sim::EventKind::kChangeRefused, BodyId(), "too large", 0},
                   {40, RobotId(), sim::EventKind::kChangeRefused, BodyId(), "in the way", 0}};
  state.done = {
      {40, RobotId(0), sim::EventKind::kContact, BodyId(2), "", 0},
      {40, RobotId(2), sim::EventKind::kPinned, BodyId(8), std::string(sim::kPinnedText), 0}};
  return state;
}

}  // namespace rave::lock_step::testing
