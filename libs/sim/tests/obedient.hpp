// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/sim_testing/engine_fixture.hpp"

/// Real robots that do what they are told, for tests of what they are told.
namespace rave::sim::testing {

/// Hands on whatever it was given last, however old: what no controller should do.
class Reckless final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup&) override { return {}; }
  Command control(const ControlInput& input) override { return input.command; }
};

/// An actuator of a real robot that obeys; the test reads what it was told.
class Obedient final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  /// Belongs to the one test that runs an engine of one real robot.
  static std::vector<Command>& told() {
    static std::vector<Command> all;
    return all;
  }
  Status open(const DeviceSetup&) override {
    told().clear();
    return {};
  }
  Status write(const Command& command, SimTime) override {
    told().push_back(command);
    return {};
  }
  void close() override {}
};

inline RobotType obedient_type(Numbers recording) {
  static constexpr HardwareActuatorOps kObedient = detail::hardware_actuator_ops<Obedient>();
  static constexpr ControllerOps kReckless = detail::controller_ops<Reckless>();
  RobotType type = real_type(recording);
  type.actuators[0].hardware_ops = &kObedient;
  type.controllers[0].ops = &kReckless;
  return type;
}

inline RobotType reckless_type() {
  static constexpr ControllerOps kReckless = detail::controller_ops<Reckless>();
  RobotType type = simulated_type();
  type.controllers[0].ops = &kReckless;
  return type;
}

inline GuardSpec fenced(std::vector<Vec2> fence_W) {
  GuardSpec spec;
  spec.fence_W = std::move(fence_W);
  return spec;
}

}  // namespace rave::sim::testing
