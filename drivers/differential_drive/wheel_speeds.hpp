// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "rave/robot/actuator.hpp"

namespace rave {

/// Speeds over ground of the two driven wheels, m/s, forward positive.
struct WheelSpeeds {
  double left_mps = 0;
  double right_mps = 0;
};

/// The wheel speeds for a body velocity. Source: R. Siegwart, I. Nourbakhsh, D. Scaramuzza,
/// "Introduction to Autonomous Mobile Robots", 2nd ed., MIT Press 2011, section 3.2.
[[nodiscard]] inline WheelSpeeds wheel_speeds(double v_mps, double w_radps,
                                              double separation_m) noexcept {
  const double half_mps = 0.5 * separation_m * w_radps;
  return {v_mps - half_mps, v_mps + half_mps};
}

/// The inverse: the velocity of the body, without lateral component.
[[nodiscard]] inline Twist2 body_velocity(WheelSpeeds wheels, double separation_m) noexcept {
  return {0.5 * (wheels.left_mps + wheels.right_mps), 0,
          (wheels.right_mps - wheels.left_mps) / separation_m};
}

/// Scales both speeds by the same factor so that the faster is at most max_mps: the curvature does
/// not change.
[[nodiscard]] inline WheelSpeeds limited(WheelSpeeds wheels, double max_mps) noexcept {
  const double fastest_mps = std::max(std::abs(wheels.left_mps), std::abs(wheels.right_mps));
  if (fastest_mps <= max_mps) return wheels;
  const double scale = max_mps / fastest_mps;
  return {scale * wheels.left_mps, scale * wheels.right_mps};
}

/// The wheel speeds for a velocity command; 0 for no command, another kind, or non-finite values.
[[nodiscard]] inline WheelSpeeds wanted_speeds(const Command& command, double separation_m,
                                               double max_mps) noexcept {
  if (command.kind != CommandKind::kVelocity) return {};
  const WheelSpeeds wanted = wheel_speeds(command.value[0], command.value[1], separation_m);
  if (!std::isfinite(wanted.left_mps) || !std::isfinite(wanted.right_mps)) return {};
  return limited(wanted, max_mps);
}

}  // namespace rave
