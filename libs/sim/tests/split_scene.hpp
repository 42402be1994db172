// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "split_drivers.hpp"

/// A crowded room for tests of worlds that several hosts share.
namespace rave::sim::testing::crowd {

inline constexpr std::uint32_t kRobots = 30;
inline constexpr std::uint64_t kSteps = 320;
inline constexpr std::uint64_t kHandStep = 198;  // when a scan is taken, too
inline constexpr RobotId kStoppedByHand(2);
inline constexpr RobotId kChangedByHand(4);
inline constexpr RobotId kFailing(24);
inline constexpr RobotId kGrowing(21);
inline constexpr RobotId kRealOfHost1(28);  // of three hosts, interleaved

inline SensorSpec noisy_laser() {
  SensorSpec sensor = laser(16, 4, 2, 2);
  sensor.processing.noise.length_sigma_m = 0.01;
  sensor.processing.latency_s = 0.025;
  return sensor;
}

inline void add_radio(RobotType& type, Numbers model) {
  add_transmitter(type, 20'000);
  add_communicator(type, model);
}

/// Talks within a range and sight, with losses and a delay of a few steps.
inline RobotType talker(double v_mps, double throw_at = 0) {
  static constexpr VirtualActuatorOps kWagon = detail::virtual_actuator_ops<Wagon>();
  RobotType type = simulated_type({{"shake", 0.05}});
  type.actuators[0].virtual_ops = &kWagon;
  type.sensors.push_back(noisy_laser());
  type.sensors.push_back(virtual_sensor<Bumper>("bumper"));
  type.sensors.push_back(virtual_sensor<Feeler>("feeler"));
  add_radio(type, {{"range_m", 3},
                   {"sight", 1},
                   {"rate", 4000},
                   {"queue", 400},
                   {"overhead", 4},
                   {"delay_s", 0.004},
                   {"jitter_s", 0.04},
                   {"loss", 0.1}});
  type.program = program<Gossip>({{"v", v_mps}, {"throw_at", throw_at}}, 2, 1);
  type.program->param_specs = kGossipParams;
  return type;
}

/// Believes a beacon of its own; `careful` ones keep their distance. Talks without limits.
inline RobotType guided(bool careful) {
  RobotType type = simulated_type();
  type.sensors.push_back(noisy_laser());
  type.sensors.push_back(virtual_sensor<Beacon>("beacon", {{"error_m", 0.05}}, 5));
  type.sensors[0].processing = {};
  type.sensors[1].processing.latency_s = 0.02;
  type.pose_from = 1;
  type.guard = GuardSpec{};
  if (careful) type.guard->separation_m = 0.05;
  type.guard->max_speed_mps = 0.4;
  add_radio(type, {{"delay_s", 0.015}, {"loss", 0.2}});
  type.program = program<Gossip>({{"v", 0.6}, {"throw_at", 0}}, 3);
  type.program->param_specs = kGossipParams;
  return type;
}

/// A real robot that ploughs through the crowd; it has a hybrid laser and listens.
inline RobotType recorded(double x_m, double y_m, double vx_mps, double vy_mps, double first_s) {
  RobotType type = real_type({{"x", x_m},
                              {"y", y_m},
                              {"vx", vx_mps},
                              {"vy", vy_mps},
                              {"first_s", first_s},
                              {"gap_s", 1.2},
                              {"gap_end_s", 1.9}});
  type.sensors[0].processing.noise.length_sigma_m = 0.002;
  type.sensors.push_back(
      hybrid<ScanRecording, Laser, Nearest>({}, {{"rays", 2}, {"fov_rad", 0.6}, {"range_m", 6}}));
  type.sensors[1].layers = kAllLayers;
  type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.004}, {"room", 16}}));
  add_radio(type, {{"range_m", 5}, {"delay_s", 0.01}});
  type.program = program<Gossip>({{"v", 0.1}, {"throw_at", 0}}, 4);
  return type;
}

inline void add_walls(EngineSpec& spec) {
  for (const Pose2& side : {Pose2{-0.5, 1.5, 0}, {3.5, 1.5, 0}}) {
    spec.world.obstacles.push_back(box(side, 0.1, 5));
  }
  for (const Pose2& side : {Pose2{1.5, -0.5, 0}, {1.5, 3.5, 0}}) {
    spec.world.obstacles.push_back(box(side, 5, 0.1));
  }
  spec.world.obstacles.push_back(box({1.5, 1.5, 0}, 0.5, 0.1));
}

inline void add_changes(EngineSpec& spec) {
  const auto to = [](const char* name, double value) {
    return ParameterChange{ParameterChange::Part::kProgram, 0, name, value};
  };
  const ParameterChange larger{ParameterChange::Part::kBody, 0, "scale", 1.1};
  const ParameterChange giant{ParameterChange::Part::kBody, 0, "scale", 9.0};
  spec.changes.push_back({3, kGrowing, {larger}});
  spec.changes.push_back({100, RobotId(5), {to("v", 0.9)}});
  spec.changes.push_back({100, RobotId(14), {to("v", 0.2)}});
  spec.changes.push_back({110, RobotId(6), {to("v", 99)}});  // refused by its host
  spec.changes.push_back({130, RobotId(22), {giant}});       // refused by the authority
  spec.changes.push_back({140, RobotId(26), {larger}});      // real: the same
}

inline ObstacleChange obstacle(ObstacleChange::Kind kind, const std::string& name,
                               const Pose2& X_WB, double side_m = 0.1) {
  ObstacleChange change;
  change.kind = kind;
  change.name = name;
  change.X_WB = X_WB;
  if (kind == ObstacleChange::Kind::kAdd) change.body = box({}, side_m, side_m).body;
  return change;
}

/// Posts between robots, one that hops over the wall and back, and what cannot be done.
inline void add_obstacle_changes(EngineSpec& spec) {
  using Kind = ObstacleChange::Kind;
  spec.obstacle_changes = {{5, obstacle(Kind::kAdd, "post", {0.9, 0.9, 0.3})},
                           {5, obstacle(Kind::kAdd, "hopper", {2.1, 0.9, 0})},
                           {6, obstacle(Kind::kAdd, "third", {2.1, 2.1, 0.7})},
                           {7, obstacle(Kind::kAdd, "fourth", {0.3, 1.5, 0})},
                           {7, obstacle(Kind::kAdd, "fifth", {1.5, 0.3, 0})},
                           {8, obstacle(Kind::kAdd, "sixth", {2.7, 1.5, 0})},
                           {60, obstacle(Kind::kMove, "hopper", {5, 5, 0})},
                           {70, obstacle(Kind::kAdd, "giant", {1.5, 1.5, 0}, 3)},  // refused
                           {120, obstacle(Kind::kRemove, "post", {})},
                           {125, obstacle(Kind::kRemove, "post", {})},  // refused
                           {260, obstacle(Kind::kMove, "third", {-2, 0, 0})},
                           {261, obstacle(Kind::kAdd, "post", {-3, 0, 0})}};
}

/// A crowded room with all that can pass between hosts.
inline EngineSpec scene(unsigned threads, std::uint64_t seed = 11) {
  EngineSpec spec;
  spec.threads = threads;
  spec.share_always = threads > 1;
  spec.seed = seed;
  add_walls(spec);
  const auto place = [](std::uint32_t i) {
    const std::uint32_t row = i / 6;
    return Pose2{0.6 * (i % 6), 0.6 * row, 0.7 * (i % 9)};
  };
  add_robot(spec, talker(0.5), place(0));
  for (std::uint32_t i = 1; i < 14; ++i) add_twin(spec, place(i));
  add_robot(spec, guided(false), place(14));
  for (std::uint32_t i = 15; i < 19; ++i) add_twin(spec, place(i));
  add_robot(spec, guided(true), place(19));
  add_robot(spec, simulated_type(), place(20));  // lets itself be pushed
  add_robot(spec, talker(0.4), place(21));
  RobotType blind = simulated_type({{"shake", 0.2}});
  blind.program = program<Drive>({{"v", 0.8}, {"w", 0.4}});
  add_robot(spec, std::move(blind), place(22));
  add_twin(spec, place(23));
  add_robot(spec, talker(0.7, 90), place(24));
  add_robot(spec, talker(0.3), place(25));
  add_robot(spec, recorded(-0.3, 0.1, 1.0, 0.8, 0), {});
  add_robot(spec, recorded(3.2, 0.4, -0.9, 0.7, 0.15), {});
  add_robot(spec, recorded(0.3, 3.2, 0.8, -0.9, 0.05), {});
  add_robot(spec, recorded(1.5, 3.2, 0.0, -0.9, 0.4), {});
  for (std::uint32_t r = 0; r < kRobots; ++r) {
    if (r % 5 != 4) spec.robots[r].team = r % 2 == 0 ? "red" : "blue";
  }
  add_changes(spec);
  add_obstacle_changes(spec);
  return spec;
}

inline std::vector<std::uint32_t> split(std::initializer_list<std::uint32_t> sizes) {
  std::vector<std::uint32_t> host_of;
  std::uint32_t host = 0;
  for (const std::uint32_t size : sizes) host_of.insert(host_of.end(), size, host++);
  return host_of;
}

inline std::vector<std::uint32_t> interleaved(std::uint32_t hosts) {
  std::vector<std::uint32_t> host_of(kRobots);
  for (std::uint32_t r = 0; r < kRobots; ++r) host_of[r] = r % hosts;
  return host_of;
}

/// The box in the middle goes.
inline ObstacleChange removed_by_hand() {
  ObstacleChange change;
  change.kind = ObstacleChange::Kind::kRemove;
  change.id = BodyId(4);
  return change;
}
inline ParameterChange speed_by_hand() { return {ParameterChange::Part::kProgram, 0, "v", 1.0}; }

}  // namespace rave::sim::testing::crowd
