// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/trigonometry.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

/// Programs and controllers that people give orders to, and such orders.
namespace rave::sim::testing {

/// Repeats its orders as text; is done with goals at once.
class Listener final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesGoal | kTakesPath | kTakesText;
  Status start(const Setup& setup) override {
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    return {};
  }
  void decide(const Percepts& percepts, Commands& commands) override {
    for (const Order order : percepts.orders()) {
      std::string text(to_string(order.kind));
      if (!order.points_W.empty()) text += fmt::format(" {} points", order.points_W.size());
      if (order.yaw_rad) text += fmt::format(" yaw {}", *order.yaw_rad);
      if (order.speed_mps > 0) text += fmt::format(" speed {}", order.speed_mps);
      if (!order.text.empty()) text += fmt::format(" {}", order.text);
      text += fmt::format(" by {}", order.by);
      if (order.kind == OrderKind::kGoal) {
        commands.done(text);
      } else {
        commands.say(text);
      }
    }
    if (percepts.is_driven() && !driven_) commands.say("driven");
    driven_ = percepts.is_driven();
    commands.velocity(drive_, 0.1, 0.2);
  }

 private:
  ControllerHandle drive_;
  bool driven_ = false;
};

/// Says something in each decision.
class Chatterer final : public DecisionProcess {
 public:
  static constexpr OrderSet kTakes = kTakesText;
  Status start(const Setup& /*setup*/) override { return {}; }
  void decide(const Percepts& /*percepts*/, Commands& commands) override {
    EXPECT_FALSE(commands.say(std::string(1001, 'a')));
    EXPECT_TRUE(commands.say("I am here"));
  }
};

/// Drives to a point, straight on and turning on the spot.
class Seeker final : public Controller {
 public:
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup& /*setup*/) override { return {}; }
  Command control(const ControlInput& input) override {
    if (input.command.kind != CommandKind::kGoal) return velocity_command(0, 0);
    const double dx_m = input.command.value[0] - input.pose.x_m;
    const double dy_m = input.command.value[1] - input.pose.y_m;
    const double error_rad = wrap_angle(atan2(dy_m, dx_m) - input.pose.yaw_rad);
    if (dx_m * dx_m + dy_m * dy_m < 0.01 * 0.01) return velocity_command(0, 0);
    if (error_rad > 0.1) return velocity_command(0, 1);
    if (error_rad < -0.1) return velocity_command(0, -1);
    return velocity_command(0.5, error_rad);
  }
};

inline RobotType listener_type() {
  RobotType type = simulated_type();
  type.program = program<Listener>({}, 2);
  return type;
}

inline RobotType chatterer_type() {
  RobotType type = simulated_type();
  type.program = program<Chatterer>();
  return type;
}

/// Its program drives ahead and takes no orders.
inline RobotType driver_type() {
  RobotType type = simulated_type();
  type.program =
      program<Drive>({{"v", 0.2}, {"w", 0}, {"quiet_after", 0}, {"throw_at", 0}, {"nan_at", 0}});
  return type;
}

/// The same, with a controller that takes goals.
inline RobotType goal_type() {
  static constexpr ControllerOps kSeek = detail::controller_ops<Seeker>();
  RobotType type = driver_type();
  ControllerSpec spec;
  spec.name = "seek";
  spec.driver = "seek";
  spec.ops = &kSeek;
  spec.accepts = CommandKind::kGoal;
  type.controllers.push_back(std::move(spec));
  return type;
}

/// Throttle and gear are its speed in m/s.
class Cart final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kPedals;
  Status start(const DeviceSetup& /*setup*/) override { return {}; }
  Twist2 propose(const MotionInput& input) override { return motion_of(input.command); }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    if (command.kind != CommandKind::kPedals) return asked_velocity(command);
    return {command.value[1] * command.value[3] * (1 - command.value[2]), 0, 0};
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return pedals_command(0, std::abs(motion.vx), motion.vx == 0 ? 1 : 0, motion.vx < 0 ? -1 : 1);
  }
};

/// Hands pedals on.
class Foot final : public Controller {
 public:
  static constexpr CommandKind kGives = CommandKind::kPedals;
  Status start(const DeviceSetup& /*setup*/) override { return {}; }
  Command control(const ControlInput& input) override { return input.command; }
};

/// Its program drives ahead; a person may take the wheel or the pedals.
inline RobotType cart_type() {
  static constexpr VirtualActuatorOps kCart = detail::virtual_actuator_ops<Cart>();
  static constexpr ControllerOps kFoot = detail::controller_ops<Foot>();
  RobotType type = driver_type();
  type.actuators[0].virtual_ops = &kCart;
  ControllerSpec spec;
  spec.name = "foot";
  spec.driver = "foot";
  spec.ops = &kFoot;
  spec.accepts = CommandKind::kPedals;
  type.controllers.push_back(std::move(spec));
  return type;
}

inline WorldInput order(RobotId robot, request::Order what) {
  WorldInput input;
  input.action = std::move(what);
  input.author.name = "anna";
  input.robot = robot;
  return input;
}

inline WorldInput drive(RobotId robot, double v_mps, double w_radps) {
  return order(robot, request::Drive{v_mps, w_radps});
}

inline WorldInput goal(RobotId robot, Vec2 p_WG, std::optional<double> yaw_rad = std::nullopt) {
  return order(robot, request::Goal{p_WG, yaw_rad});
}

inline WorldInput path(RobotId robot, std::vector<Vec2> points_W, double speed_mps = 0) {
  return order(robot, request::Path{std::move(points_W), speed_mps});
}

inline WorldInput cancel(RobotId robot) { return order(robot, request::Cancel{}); }

inline WorldInput words(RobotId robot, std::string text) {
  return order(robot, request::Text{std::move(text)});
}

inline WorldInput place(RobotId robot, Vec2 p_WR, std::optional<double> yaw_rad = std::nullopt) {
  return order(robot, request::Place{p_WR, yaw_rad});
}

}  // namespace rave::sim::testing
