// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

#include "differential_drive_dynamic/second_order.hpp"
#include "rave/math/scalar.hpp"
#include "rave/plugin/params.hpp"

namespace rave {

/// The parameters of DrivenWheels.
inline constexpr ParamSpec kDrivenWheelParams[] = {
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

/// The parameters of a drive, followed by those of its wheels.
template <std::size_t kOwn>
constexpr auto with_driven_wheels(const ParamSpec (&own)[kOwn]) noexcept {
  std::array<ParamSpec, kOwn + std::size(kDrivenWheelParams)> all{};
  std::copy(std::begin(own), std::end(own), all.begin());
  std::copy(std::begin(kDrivenWheelParams), std::end(kDrivenWheelParams), all.begin() + kOwn);
  return all;
}

/// One wheel with motor, speed control and slip.
struct DrivenWheel {
  double reference_mps = 0;  ///< The command after the motor's lag.
  SpeedState speed;
  double slip_left_s = 0;  ///< Remaining time of the slip.

  /// From now on at this speed, without acceleration. A slip continues.
  void restart(double speed_mps) noexcept {
    reference_mps = speed_mps;
    speed = {speed_mps, 0};
  }
};

/// How the wheels of one robot follow their commands. A value.
class DrivenWheels {
 public:
  /// Takes the values of kDrivenWheelParams.
  void set(const Params& params, double dt_s) {
    natural_frequency_radps_ = params.number("natural_frequency_radps");
    damping_ratio_ = params.number("damping_ratio");
    time_constant_s_ = params.number("motor_time_constant_s");
    max_acceleration_mps2_ = params.number("max_wheel_acceleration_mps2");
    slip_rate_per_s_ = params.number("slip_probability_per_s");
    slip_factor_ = params.number("slip_factor");
    slip_duration_s_ = params.number("slip_duration_s");
    prepare(dt_s);
  }

  /// For steps of `dt_s` from now on.
  void prepare(double dt_s) {
    dt_s_ = dt_s;
    // Exact for a command that is constant during the step, so the response does not depend on the
    // step (Franklin, Powell, Emami-Naeini, "Feedback Control of Dynamic Systems", chapter 3).
    transition_ = second_order_transition(natural_frequency_radps_, damping_ratio_, dt_s);
    lag_ = time_constant_s_ > 0 ? exp(-dt_s / time_constant_s_) : 0;
    // A Poisson process with this rate: the chance of at least one beginning within a step.
    slip_chance_ = 1.0 - exp(-slip_rate_per_s_ * dt_s);
  }
  [[nodiscard]] double dt_s() const noexcept { return dt_s_; }
  [[nodiscard]] double max_acceleration_mps2() const noexcept { return max_acceleration_mps2_; }

  /// One step of one wheel; returns its speed over ground at the end of the step. `draw` is uniform
  /// in [0, 1).
  double advance(DrivenWheel& wheel, double wanted_mps, double draw) const noexcept {
    return advance(wheel, wanted_mps, draw, max_acceleration_mps2_);
  }
  /// The same with another largest acceleration, as under a brake.
  double advance(DrivenWheel& wheel, double wanted_mps, double draw,
                 double max_acceleration_mps2) const noexcept {
    wheel.reference_mps = wanted_mps + lag_ * (wheel.reference_mps - wanted_mps);
    wheel.speed =
        advanced(wheel.speed, wheel.reference_mps, transition_, max_acceleration_mps2, dt_s_);
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

 private:
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
};

}  // namespace rave
