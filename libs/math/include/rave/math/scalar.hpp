// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/exponential.hpp"
#include "rave/math/trigonometry.hpp"

/// All elementary functions that RAVE uses. Those of the C library differ between processors, so
/// code that affects the hash of a run must not call them.
namespace rave {

/// Tangent, within 3 ulp.
[[nodiscard]] inline double tan(double angle_rad) noexcept {
  const SinCos both = sincos(angle_rad);
  return both.sin / both.cos;
}

/// Arc sine in [-pi/2, pi/2], within 3 ulp; NaN outside [-1, 1].
[[nodiscard]] inline double asin(double x) noexcept {
  if (!(std::abs(x) <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  return atan2(x, std::sqrt((1.0 - x) * (1.0 + x)));
}

/// Arc cosine in [0, pi], within 3 ulp; NaN outside [-1, 1].
[[nodiscard]] inline double acos(double x) noexcept {
  if (!(std::abs(x) <= 1.0)) return std::numeric_limits<double>::quiet_NaN();
  return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x);
}

namespace detail {
[[nodiscard]] double wrap_outside(double angle) noexcept;
}  // namespace detail

/// The equivalent angle in (-pi, pi]. Angles in that range keep their bits; others have the error
/// of one rounding. NaN for infinities and NaN.
[[nodiscard]] inline double wrap_angle(double angle_rad) noexcept {
  if (angle_rad > -kPi && angle_rad <= kPi) return angle_rad;
  return detail::wrap_outside(angle_rad);
}

/// Degrees to radians.
[[nodiscard]] constexpr double deg_to_rad(double angle_deg) noexcept {
  return angle_deg * (kPi / 180.0);
}
/// Radians to degrees.
[[nodiscard]] constexpr double rad_to_deg(double angle_rad) noexcept {
  return angle_rad * (180.0 / kPi);
}

}  // namespace rave
