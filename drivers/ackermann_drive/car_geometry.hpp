// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/robot/actuator.hpp"

namespace rave {

/// What the wheels of a car are asked for.
struct CarWish {
  double speed_mps = 0;  ///< Backward: negative.
  double steering_rad = 0;
  double brake = 0;  ///< Share, from 0 to 1.
  double gear = 1;   ///< 1, 0 or -1.
};

/// A car as a bicycle: the origin of the body is the middle of the rear axle, which does not slide.
/// Source: K. Lynch, F. Park, "Modern Robotics", Cambridge University Press 2017, section 13.3.1.2.
/// A value; all functions are pure.
struct CarGeometry {
  double wheel_base_m = 0.3;
  double max_steering_rad = 0.5;
  double max_speed_mps = 1;
  double max_reverse_mps = 1;

  void set(const Params& params) {
    wheel_base_m = params.number("wheel_base_m");
    max_steering_rad = deg_to_rad(params.number("max_steering_deg"));
    max_speed_mps = params.number("max_speed_mps");
    max_reverse_mps = params.number("max_reverse_mps");
  }

  /// Of pedals or a velocity. Anything else, and what is not finite, is a foot on the brake.
  [[nodiscard]] CarWish wish(const Command& command) const noexcept {
    if (command.kind == CommandKind::kVelocity) return wish(command_for(asked_velocity(command)));
    const double sum = command.value[0] + command.value[1] + command.value[2] + command.value[3];
    if (command.kind != CommandKind::kPedals || !std::isfinite(sum)) return {.brake = 1};
    CarWish wish;
    wish.steering_rad = max_steering_rad * std::clamp(command.value[0], -1.0, 1.0);
    wish.brake = std::clamp(command.value[2], 0.0, 1.0);
    wish.gear = command.value[3] > 0.5 ? 1 : command.value[3] < -0.5 ? -1 : 0;
    const double share = std::clamp(command.value[1], 0.0, 1.0) * (1 - wish.brake);
    if (wish.gear > 0) wish.speed_mps = share * max_speed_mps;
    if (wish.gear < 0) wish.speed_mps = -share * max_reverse_mps;
    return wish;
  }

  [[nodiscard]] Twist2 motion(double speed_mps, double steering_rad) const noexcept {
    return {speed_mps, 0, speed_mps * tan(steering_rad) / wheel_base_m};
  }
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    const CarWish asked = wish(command);
    return motion(asked.speed_mps, asked.steering_rad);
  }

  /// What it cannot reach is brought down on the same curve; a curve that is too narrow becomes the
  /// narrowest. It does not turn on the spot.
  [[nodiscard]] Command command_for(const Twist2& wanted) const noexcept {
    const double most_mps = wanted.vx > 0 ? max_speed_mps : max_reverse_mps;
    if (std::abs(wanted.vx) < kStands_mps || most_mps <= 0) return pedals_command(0, 0, 1, 1);
    const double angle_rad = atan2(wheel_base_m * wanted.wz / wanted.vx, 1);
    const double share = max_steering_rad > 0 ? angle_rad / max_steering_rad : 0;
    return pedals_command(std::clamp(share, -1.0, 1.0),
                          std::min(std::abs(wanted.vx) / most_mps, 1.0), 0, wanted.vx > 0 ? 1 : -1);
  }

  static constexpr double kStands_mps = 1e-9;
};

}  // namespace rave
