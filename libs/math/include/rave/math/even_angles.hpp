// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

namespace rave {

/// Whether there are rays, and at equal angles, as the LaserScan of ROS 2 requires.
[[nodiscard]] inline bool evenly_spread(std::span<const double> bearings_rad) noexcept {
  // Bearings computed as first + i * step differ from exact ones by rounding only; 1e-6 rad are
  // 0.03 mm at 30 m.
  constexpr double kEven_rad = 1e-6;
  if (bearings_rad.empty()) return false;
  const double steps = static_cast<double>(bearings_rad.size() - 1);
  const double step_rad = steps > 0 ? (bearings_rad.back() - bearings_rad.front()) / steps : 0;
  for (std::size_t i = 0; i < bearings_rad.size(); ++i) {
    const double expected = bearings_rad.front() + static_cast<double>(i) * step_rad;
    if (!(std::abs(bearings_rad[i] - expected) <= kEven_rad)) return false;
  }
  return true;
}

}  // namespace rave
