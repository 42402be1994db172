// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "rave/robot/pure_pursuit.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("max_speed_mps", "m/s", 0.5, 0.001, 100, "Largest speed."),
    number_param("max_turn_rate_radps", "rad/s", 2.0, 0.001, 100, "Largest turning rate."),
    number_param(
        "max_deceleration_mps2", "m/s^2", 0.5, 0.001, 100,
        "Deceleration that the robot always reaches; determines where it begins to slow down."),
    number_param("tolerance_m", "m", 0.05, 0.001, 100,
                 "Distance at which the goal counts as reached."),
    number_param("distance_gain_per_s", "1/s", 1.0, 0.01, 100, "Speed per metre of distance."),
    number_param("heading_gain_per_s", "1/s", 3.0, 0.01, 100,
                 "Turning rate per radian of heading error."),
    number_param("turn_in_place_rad", "rad", 1.0, 0.1, 1.5,
                 "With a larger heading error it turns without driving."),
    number_param("min_turn_radius_m", "m", 0, 0, 100,
                 "Radius of the narrowest curve of a car; 0: it turns on the spot."),
    number_param("watchdog_s", "s", 1.0, 0.001, 3600,
                 "Age of the last command after which the robot stops."),
};

/// Drives to a point of the world by the reported pose.
/// Law: M. Aicardi, G. Casalino, A. Bicchi, A. Balestrino, "Closed loop steering of unicycle-like
/// vehicles via Lyapunov techniques", IEEE Robotics & Automation Magazine 2(1), 1995, without the
/// term for the final orientation. See README.md.
class GoalPointController final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kGoal;
  static constexpr CommandKind kGives = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    host_ = setup.host;
    complained_ = false;
    return parameters_changed(setup.parameters());
  }

  Status parameters_changed(const Params& params) override {
    max_speed_mps_ = params.number("max_speed_mps");
    max_turn_rate_radps_ = params.number("max_turn_rate_radps");
    max_deceleration_mps2_ = params.number("max_deceleration_mps2");
    tolerance_m_ = params.number("tolerance_m");
    distance_gain_per_s_ = params.number("distance_gain_per_s");
    heading_gain_per_s_ = params.number("heading_gain_per_s");
    turn_in_place_rad_ = params.number("turn_in_place_rad");
    min_radius_m_ = params.number("min_turn_radius_m");
    pursuit_ = PursuitOfCar(min_radius_m_);
    watchdog_s_ = params.number("watchdog_s");
    return {};
  }

  Command control(const ControlInput& input) override {
    const Command& goal = input.command;
    if (goal.kind != kAccepts || !(input.command_age_s <= watchdog_s_)) return kStop;
    if (!finite(input)) {
      complain();
      return kStop;
    }
    const double dx_m = goal.value[0] - input.pose.x_m;
    const double dy_m = goal.value[1] - input.pose.y_m;
    const double distance_m = hypot(dx_m, dy_m);
    if (distance_m <= tolerance_m_) return kStop;
    if (min_radius_m_ > 0) {
      const Pose2 X_WR{input.pose.x_m, input.pose.y_m, input.pose.yaw_rad};
      return pursue(transform_back(X_WR, {goal.value[0], goal.value[1]}), distance_m,
                    speed_limit(goal.value[2]));
    }
    return drive(distance_m, wrap_angle(atan2(dy_m, dx_m) - input.pose.yaw_rad),
                 speed_limit(goal.value[2]));
  }

 private:
  static constexpr Command kStop = velocity_command(0, 0);

  static bool finite(const ControlInput& input) {
    // The sum may overflow even if all terms are finite; such goals are refused too.
    return std::isfinite(input.command.value[0] + input.command.value[1] + input.command.value[2] +
                         input.pose.x_m + input.pose.y_m + input.pose.yaw_rad);
  }

  double speed_limit(double wanted_mps) const {
    return wanted_mps > 0 ? std::min(wanted_mps, max_speed_mps_) : max_speed_mps_;
  }

  Command drive(double distance_m, double error_rad, double limit_mps) const {
    // Far off its heading the robot would drive a wide curve; turning first keeps it near the
    // straight way.
    if (std::abs(error_rad) > turn_in_place_rad_) {
      return velocity_command(0, std::clamp(heading_gain_per_s_ * error_rad, -max_turn_rate_radps_,
                                            max_turn_rate_radps_));
    }
    // The highest speed from which the robot can stop at the goal: v^2 = 2 a d.
    const double braking_mps = std::sqrt(2.0 * max_deceleration_mps2_ * distance_m);
    const double gain_per_s =
        std::min({distance_gain_per_s_, limit_mps / distance_m, braking_mps / distance_m});
    const SinCos error = sincos(error_rad);
    const double v_mps = gain_per_s * distance_m * error.cos;
    const double w_radps = heading_gain_per_s_ * error_rad + gain_per_s * error.sin * error.cos;
    // Scaling both velocities keeps the curvature, so the path stays that of the control law.
    const double scale = std::min(1.0, max_turn_rate_radps_ / std::max(std::abs(w_radps), 1e-9));
    return velocity_command(scale * v_mps, scale * w_radps);
  }

  /// A car: on the arc through the goal, slower near it.
  Command pursue(Vec2 goal_R, double distance_m, double limit_mps) {
    const double braking_mps = std::sqrt(2.0 * max_deceleration_mps2_ * distance_m);
    const double speed_mps = std::min({limit_mps, braking_mps, distance_gain_per_s_ * distance_m,
                                       max_turn_rate_radps_ * min_radius_m_});
    const PursuitOfCar::Velocity velocity = pursuit_.toward(goal_R, speed_mps);
    return velocity_command(velocity.v_mps, velocity.w_radps);
  }

  void complain() {
    if (complained_) return;
    complained_ = true;
    host_.write(LogLevel::kWarning,
                "the goal or the reported pose is not finite; the robot stops; later ones are not "
                "reported");
  }

  HostServices host_;
  double max_speed_mps_ = 0;
  double max_turn_rate_radps_ = 0;
  double max_deceleration_mps2_ = 0;
  double tolerance_m_ = 0;
  double distance_gain_per_s_ = 0;
  double heading_gain_per_s_ = 0;
  double turn_in_place_rad_ = 0;
  double min_radius_m_ = 0;
  PursuitOfCar pursuit_;
  double watchdog_s_ = 0;
  bool complained_ = false;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("goal_point") {
  rave::add_controller<rave::GoalPointController>(
      registry, {.name = "goal_point",
                 .summary = "Drives to a point of the world by the reported pose, and stops there.",
                 .params = rave::kParams});
}
