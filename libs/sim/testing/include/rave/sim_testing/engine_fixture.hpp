// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim_testing/engine_drivers.hpp"

/// Builds small worlds for tests of the engine.
namespace rave::sim::testing {

using Numbers = std::initializer_list<std::pair<const char*, double>>;

inline plugin::ParamSet numbers(Numbers values) {
  plugin::ParamSet set;
  for (const auto& [name, value] : values) set.add_number(name, value);
  return set;
}

/// Keeps all messages.
class Ears final : public LogSink {
 public:
  void write(LogLevel, std::string_view source, std::string_view message) override {
    heard += fmt::format("{}: {}\n", source, message);
  }
  std::string heard;
};

/// A live run in which no time passes.
class ClockAtZero final : public RunClock {
 public:
  [[nodiscard]] SimTime now() const noexcept override { return {}; }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime) const noexcept override {
    return {};
  }
};

inline world::Body disc_body(Layer layer, double radius_m = 0.15, double z1_m = 0.3) {
  world::Body body;
  body.shapes.push_back(world::make_disc({}, radius_m, 0, z1_m).value());
  body.layer = layer;
  return body;
}

inline world::Obstacle box(const Pose2& X_WB, double length_m, double width_m, double z1_m = 1,
                           const std::string& name = "box") {
  world::Obstacle obstacle;
  const double x = length_m / 2;
  const double y = width_m / 2;
  obstacle.body.name = name;
  obstacle.body.shapes =
      world::make_prisms(std::vector<Vec2>{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0, z1_m).value();
  obstacle.X_WB = X_WB;
  return obstacle;
}

template <class T>
SensorSpec virtual_sensor(const std::string& name, Numbers params = {}, std::uint32_t period = 1) {
  SensorSpec sensor;
  sensor.name = name;
  sensor.driver = name;
  sensor.kind = T::kReading;
  sensor.virtual_ops = sensor_ops<T>();
  sensor.params = numbers(params);
  sensor.period_steps = period;
  sensor.z_m = 0.1;
  return sensor;
}

template <class T>
SensorSpec real_sensor(const std::string& name, Numbers params) {
  SensorSpec sensor;
  sensor.name = name;
  sensor.driver = name;
  sensor.kind = T::kReading;
  sensor.hardware_ops = hardware_ops<T>();
  sensor.params = numbers(params);
  return sensor;
}

inline SensorSpec laser(std::uint32_t rays = 1, double fov_rad = 0, double range_m = 3,
                        std::uint32_t period = 1) {
  return virtual_sensor<Laser>(
      "laser", {{"rays", double{1} * rays}, {"fov_rad", fov_rad}, {"range_m", range_m}}, period);
}

template <class T>
ProgramSpec program(Numbers params = {}, std::uint32_t period = 1, std::uint32_t phase = 0) {
  ProgramSpec spec;
  spec.driver = "program";
  spec.ops = program_table<T>();
  spec.params = numbers(params);
  spec.period_steps = period;
  spec.phase_steps = phase;
  return spec;
}

inline void add_drive(RobotType& type, Numbers controller = {}) {
  static constexpr ControllerOps kPass = detail::controller_ops<Pass>();
  ControllerSpec spec;
  spec.name = "drive";
  spec.driver = "pass";
  spec.ops = &kPass;
  spec.params = numbers(controller);
  spec.accepts = CommandKind::kVelocity;
  type.controllers.push_back(std::move(spec));
}

/// A simulated robot with wheels; sensors and program are for the test to add.
inline RobotType simulated_type(Numbers wheels = {}, Numbers controller = {}) {
  static constexpr VirtualActuatorOps kWheels = detail::virtual_actuator_ops<Wheels>();
  RobotType type;
  ActuatorSpec actuator;
  actuator.name = "wheels";
  actuator.driver = "wheels";
  actuator.virtual_ops = &kWheels;
  actuator.params = numbers(wheels);
  type.actuators.push_back(std::move(actuator));
  add_drive(type, controller);
  return type;
}

/// A real robot that a Recording moves; its actuator does not obey.
inline RobotType real_type(Numbers recording) {
  static constexpr HardwareActuatorOps kDeaf = detail::hardware_actuator_ops<Deaf>();
  RobotType type;
  type.simulated = false;
  ActuatorSpec actuator;
  actuator.name = "wheels";
  actuator.driver = "deaf";
  actuator.hardware_ops = &kDeaf;
  type.actuators.push_back(std::move(actuator));
  add_drive(type);
  type.sensors.push_back(real_sensor<Recording>("mocap", recording));
  type.pose_from = 0;
  return type;
}

/// Adds a type and one robot of it; returns the robot.
inline RobotId add_robot(EngineSpec& spec, RobotType type, const Pose2& X_WR = {},
                         double z1_m = 0.3) {
  const auto id = static_cast<std::uint32_t>(spec.robots.size());
  spec.world.robots.push_back(
      disc_body(type.simulated ? Layer::kSimulatedRobots : Layer::kRealRobots, 0.15, z1_m));
  spec.robots.push_back(
      {"r" + std::to_string(id), "", static_cast<std::uint32_t>(spec.types.size()), X_WR});
  spec.types.push_back(std::move(type));
  return RobotId(id);
}

/// Adds another robot of the type that was added last.
inline RobotId add_twin(EngineSpec& spec, const Pose2& X_WR) {
  const auto id = static_cast<std::uint32_t>(spec.robots.size());
  spec.world.robots.push_back(spec.world.robots.back());
  spec.robots.push_back(
      {"r" + std::to_string(id), "", static_cast<std::uint32_t>(spec.types.size() - 1), X_WR});
  return RobotId(id);
}

inline std::unique_ptr<Engine> make_engine(EngineSpec spec) {
  auto engine = Engine::create(std::move(spec));
  if (!engine) ADD_FAILURE() << engine.error().text();
  return engine ? *std::move(engine) : nullptr;
}

/// Runs `steps`; returns all events.
inline std::vector<Event> run(Engine& engine, int steps) {
  std::vector<Event> events;
  for (int i = 0; i < steps; ++i) {
    const Status status = engine.step();
    if (!status) {
      ADD_FAILURE() << status.error().text();
      return events;
    }
    events.insert(events.end(), engine.events().begin(), engine.events().end());
  }
  return events;
}

inline std::vector<Event> of_kind(const std::vector<Event>& events, EventKind kind) {
  std::vector<Event> found;
  for (const Event& event : events) {
    if (event.kind == kind) found.push_back(event);
  }
  return found;
}

inline float range(const Engine& engine, RobotId robot, std::uint32_t sensor, std::size_t ray = 0) {
  return static_cast<const float*>(engine.sensor(robot, sensor).records)[ray];
}

}  // namespace rave::sim::testing
