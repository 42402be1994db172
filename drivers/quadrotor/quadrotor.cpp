// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "differential_drive_dynamic/second_order.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"

namespace rave {
namespace {

constexpr double kGravity_mps2 = 9.80665;

constexpr ParamSpec kParams[] = {
    number_param("max_speed_mps", "m/s", 2.0, 0, 100, "Largest speed, in any direction."),
    number_param("max_turn_rate_radps", "rad/s", 2.0, 0, 100, "Largest yaw rate, both ways."),
};
constexpr ParamSpec kDynamicParams[] = {
    kParams[0],
    kParams[1],
    number_param("natural_frequency_radps", "rad/s", 4.0, 0.01, 1000,
                 "Natural frequency of the control of each velocity."),
    number_param("damping_ratio", "", 0.8, 0, 100,
                 "Damping of that control; below 1 it overshoots."),
    number_param("max_tilt_deg", "deg", 20, 0.1, 80,
                 "Largest tilt; the acceleration is at most g tan(tilt)."),
    number_param("gust_probability_per_s", "1/s", 0, 0, 1000,
                 "Rate at which gusts begin in still air; 0: never."),
    number_param("gust_mps", "m/s", 0.5, 0, 100, "Drift during a gust, in a random direction."),
    number_param("gust_duration_s", "s", 0.5, 0.001, 60, "Duration of one gust."),
};

/// A multicopter seen from above, at the height of its body.
struct Limits {
  double max_speed_mps = 0;
  double max_turn_radps = 0;

  void set(const Params& params) {
    max_speed_mps = params.number("max_speed_mps");
    max_turn_radps = params.number("max_turn_rate_radps");
  }
  /// The direction stays; the yaw rate is limited by itself.
  [[nodiscard]] Twist2 limited(const Command& command) const noexcept {
    Twist2 asked = asked_velocity(command);
    const double speed_mps = hypot(asked.vx, asked.vy);
    if (!std::isfinite(speed_mps)) return {};
    if (speed_mps > max_speed_mps) {
      asked.vx *= max_speed_mps / speed_mps;
      asked.vy *= max_speed_mps / speed_mps;
    }
    asked.wz = std::clamp(asked.wz, -max_turn_radps, max_turn_radps);
    return asked;
  }
};

Command flight_command(const Twist2& motion) noexcept {
  return velocity_command(motion.vx, motion.wz, motion.vy);
}

/// Reaches any velocity within its limits at once.
class Quadrotor final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override { return parameters_changed(setup.parameters()); }
  Status parameters_changed(const Params& params) override {
    limits_.set(params);
    return {};
  }

  Twist2 propose(const MotionInput& input) override { return motion_of(input.command); }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return limits_.limited(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return flight_command(motion);
  }

 private:
  Limits limits_;
};

/// Tilts to change its velocity, which follows as a second-order system, and drifts in gusts.
class QuadrotorDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    ahead_ = {};
    left_ = {};
    turn_ = {};
    gust_left_s_ = 0;
    take(setup.parameters(), setup.step_s);
    return {};
  }
  /// The velocity stays as it is.
  Status parameters_changed(const Params& params) override {
    take(params, dt_s_);
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != dt_s_) prepare(input.dt_s);
    if (input.contact != 0) {
      ahead_ = {input.velocity.vx, 0};
      left_ = {input.velocity.vy, 0};
      turn_ = {input.velocity.wz, 0};
    }
    const Twist2 wanted = motion_of(input.command);
    ahead_ = advanced(ahead_, wanted.vx, transition_, max_acceleration_mps2_, dt_s_);
    left_ = advanced(left_, wanted.vy, transition_, max_acceleration_mps2_, dt_s_);
    // A turn needs no tilt.
    turn_ = advanced(turn_, wanted.wz, transition_, 1e9, dt_s_);
    const Vec2 drift_mps = gust(input.random());
    return {ahead_.speed_mps + drift_mps.x, left_.speed_mps + drift_mps.y, turn_.speed_mps};
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return limits_.limited(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return flight_command(motion);
  }

 private:
  void take(const Params& params, double dt_s) {
    limits_.set(params);
    natural_frequency_radps_ = params.number("natural_frequency_radps");
    damping_ratio_ = params.number("damping_ratio");
    max_acceleration_mps2_ = kGravity_mps2 * tan(deg_to_rad(params.number("max_tilt_deg")));
    gust_rate_per_s_ = params.number("gust_probability_per_s");
    gust_mps_ = params.number("gust_mps");
    gust_duration_s_ = params.number("gust_duration_s");
    prepare(dt_s);
  }
  void prepare(double dt_s) {
    dt_s_ = dt_s;
    transition_ = second_order_transition(natural_frequency_radps_, damping_ratio_, dt_s);
    gust_chance_ = 1.0 - exp(-gust_rate_per_s_ * dt_s);
  }

  /// The drift of this step. Takes the same draws in each.
  Vec2 gust(RandomStream random) {
    const double draw = random.uniform();
    const double direction_rad = random.uniform(-kPi, kPi);
    // Compare with half a step, so that rounding does not end a gust of whole steps early or late.
    if (gust_left_s_ > 0.5 * dt_s_) {
      gust_left_s_ -= dt_s_;
      return drift_mps_;
    }
    gust_left_s_ = draw < gust_chance_ ? gust_duration_s_ : 0;
    const SinCos direction = sincos(direction_rad);
    drift_mps_ = {gust_mps_ * direction.cos, gust_mps_ * direction.sin};
    return {};
  }

  Limits limits_;
  double natural_frequency_radps_ = 0;
  double damping_ratio_ = 0;
  double max_acceleration_mps2_ = 0;
  double gust_rate_per_s_ = 0;
  double gust_mps_ = 0;
  double gust_duration_s_ = 0;
  double gust_chance_ = 0;
  double gust_left_s_ = 0;
  Vec2 drift_mps_;
  double dt_s_ = 0;
  Transition transition_;
  SpeedState ahead_;
  SpeedState left_;
  SpeedState turn_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("quadrotor quadrotor_dynamic") {
  rave::add_virtual_actuator<rave::Quadrotor>(
      registry, {.name = "quadrotor",
                 .summary = "Kinematic multicopter at a fixed height: forward, sideways and "
                            "turning at once.",
                 .params = rave::kParams});
  rave::add_virtual_actuator<rave::QuadrotorDynamic>(
      registry, {.name = "quadrotor_dynamic",
                 .summary = "Multicopter at a fixed height with second-order velocities, limited "
                            "tilt and occasional gusts.",
                 .params = rave::kDynamicParams});
}
