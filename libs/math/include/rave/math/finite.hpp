// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "rave/math/pose.hpp"

namespace rave {

/// Whether no number is infinite or NaN.
[[nodiscard]] inline bool is_finite(std::span<const double> numbers) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}
/// Whether no number is infinite or NaN.
[[nodiscard]] inline bool is_finite(Vec2 p) noexcept {
  return std::isfinite(p.x) && std::isfinite(p.y);
}
/// Whether all members of a pose are finite.
[[nodiscard]] inline bool is_finite(const Pose2& X) noexcept {
  return std::isfinite(X.x) && std::isfinite(X.y) && std::isfinite(X.yaw);
}
/// Whether all members of a velocity are finite.
[[nodiscard]] inline bool is_finite(const Twist2& v) noexcept {
  return std::isfinite(v.vx) && std::isfinite(v.vy) && std::isfinite(v.wz);
}

}  // namespace rave
