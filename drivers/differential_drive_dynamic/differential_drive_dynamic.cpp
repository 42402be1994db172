// SPDX-License-Identifier: Apache-2.0
#include "differential_drive/wheel_speeds.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/plugin_entry.hpp"
#include "second_order.hpp"

namespace rave {
namespace {

constexpr ParamSpec kParams[] = {
    number_param("wheel_separation_m", "m", 0.3, 0.001, 100,
                 "Distance between the points where the two driven wheels touch the floor."),
    number_param("max_wheel_speed_mps", "m/s", 1.0, 0, 100, "Largest commanded wheel speed."),
    number_param("natural_frequency_radps", "rad/s", 15.0, 0.01, 1000,
                 "Natural frequency of each wheel's speed control."),
    number_param("damping_ratio", "", 0.8, 0, 100,
                 "Damping of each wheel's speed control; below 1 it overshoots."),
    number_param("motor_time_constant_s", "s", 0, 0, 100,
                 "First-order lag between the command and the speed control; 0: none."),
    number_param("max_wheel_acceleration_mps2", "m/s^2", 5.0, 0.001, 10'000,
                 "Largest acceleration of each wheel, both ways."),
    number_param("slip_probability_per_s", "1/s", 0, 0, 1000,
                 "Rate at which a gripping wheel begins to slip; 0: never."),
    number_param("slip_factor", "", 0.3, 0, 1,
                 "Fraction of its speed that a slipping wheel transfers to the floor."),
    number_param("slip_duration_s", "s", 0.2, 0.001, 60, "Duration of one slip."),
};

/// One wheel with motor, speed control and slip.
struct Wheel {
  double reference_mps = 0;  ///< The command after the motor's lag.
  SpeedState speed;
  double slip_left_s = 0;  ///< Remaining time of the slip.
};

/// Two driven wheels with second-order speed control and occasional slip.
class DifferentialDriveDynamic final : public VirtualActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;

  Status start(const DeviceSetup& setup) override {
    dt_s_ = setup.step_s;
    left_ = {};
    right_ = {};
    return parameters_changed(setup.parameters());
  }

  /// The wheels keep their present speeds.
  Status parameters_changed(const Params& params) override {
    separation_m_ = params.number("wheel_separation_m");
    max_mps_ = params.number("max_wheel_speed_mps");
    natural_frequency_radps_ = params.number("natural_frequency_radps");
    damping_ratio_ = params.number("damping_ratio");
    time_constant_s_ = params.number("motor_time_constant_s");
    max_acceleration_mps2_ = params.number("max_wheel_acceleration_mps2");
    slip_rate_per_s_ = params.number("slip_probability_per_s");
    slip_factor_ = params.number("slip_factor");
    slip_duration_s_ = params.number("slip_duration_s");
    prepare(dt_s_);
    return {};
  }

  Twist2 propose(const MotionInput& input) override {
    if (input.dt_s != dt_s_) prepare(input.dt_s);
    // A contact takes the speed from the wheels. Otherwise the robot would jump to its old speed as
    // soon as the contact ends.
    if (input.contact != 0) restart_from(input.velocity);
    const WheelSpeeds wanted = wanted_speeds(input.command, separation_m_, max_mps_);
    // Always take two draws, so that slip of one wheel does not change the random numbers of the
    // other.
    RandomStream random = input.random();
    const double left_draw = random.uniform();
    const double right_draw = random.uniform();
    return body_velocity(
        {advance(left_, wanted.left_mps, left_draw), advance(right_, wanted.right_mps, right_draw)},
        separation_m_);
  }

 private:
  void prepare(double dt_s) {
    dt_s_ = dt_s;
    // Exact for a command that is constant during the step, so the response does not depend on the
    // step (Franklin, Powell, Emami-Naeini, "Feedback Control of Dynamic Systems", chapter 3).
    transition_ = second_order_transition(natural_frequency_radps_, damping_ratio_, dt_s);
    lag_ = time_constant_s_ > 0 ? exp(-dt_s / time_constant_s_) : 0;
    // A Poisson process with this rate: the chance of at least one beginning within a step.
    slip_chance_ = 1.0 - exp(-slip_rate_per_s_ * dt_s);
  }

  void restart_from(const Twist2& velocity) {
    const WheelSpeeds now = wheel_speeds(velocity.vx, velocity.wz, separation_m_);
    left_ = {now.left_mps, {now.left_mps, 0}, left_.slip_left_s};
    right_ = {now.right_mps, {now.right_mps, 0}, right_.slip_left_s};
  }

  /// One step of one wheel; returns its speed over ground at the end of the step.
  double advance(Wheel& wheel, double wanted_mps, double draw) const {
    wheel.reference_mps = wanted_mps + lag_ * (wheel.reference_mps - wanted_mps);
    wheel.speed =
        advanced(wheel.speed, wheel.reference_mps, transition_, max_acceleration_mps2_, dt_s_);
    // Compare with half a step, so that rounding does not end a slip of whole steps one step early
    // or late.
    const bool slips = wheel.slip_left_s > 0.5 * dt_s_;
    if (slips) {
      wheel.slip_left_s -= dt_s_;
    } else {
      wheel.slip_left_s = draw < slip_chance_ ? slip_duration_s_ : 0;
    }
    return slips ? slip_factor_ * wheel.speed.speed_mps : wheel.speed.speed_mps;
  }

  double separation_m_ = 0;
  double max_mps_ = 0;
  double natural_frequency_radps_ = 0;
  double damping_ratio_ = 0;
  double time_constant_s_ = 0;
  double max_acceleration_mps2_ = 0;
  double slip_rate_per_s_ = 0;
  double slip_factor_ = 0;
  double slip_duration_s_ = 0;
  double dt_s_ = 0;
  Transition transition_;
  double lag_ = 0;
  double slip_chance_ = 0;
  Wheel left_;
  Wheel right_;
};

}  // namespace
}  // namespace rave

RAVE_PLUGIN("differential_drive_dynamic") {
  rave::add_virtual_actuator<rave::DifferentialDriveDynamic>(
      registry, {.name = "differential_drive_dynamic",
                 .summary = "Differential drive with second-order wheels, limited acceleration and "
                            "occasional wheel slip.",
                 .params = rave::kParams});
}
