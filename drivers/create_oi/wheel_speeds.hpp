// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rave::oi {

/// Wheel speeds in a command, mm/s, forward positive.
struct WheelSpeeds {
  std::int32_t left_mmps = 0;
  std::int32_t right_mmps = 0;

  friend bool operator==(const WheelSpeeds&, const WheelSpeeds&) = default;
};

/// Wheel speeds for a body velocity: v -+ w * wheel_base / 2. If one of them exceeds `max_mmps`,
/// both are scaled by the same factor, so that the curvature does not change.
[[nodiscard]] WheelSpeeds wheel_speeds(double v_mps, double w_radps, double wheel_base_m,
                                       double max_mmps) noexcept;

}  // namespace rave::oi
