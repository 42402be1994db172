// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/scalar.hpp"
#include "rave/plugin/params.hpp"

namespace rave::pose_doubt {

/// Variance of x and y each, and of the heading.
struct Doubt {
  double variance_xy_m2 = 0;
  double variance_yaw_rad2 = 0;
};

/// The parameter `position_sigma_m`.
constexpr ParamSpec position_sigma(double sigma_m, const char* doc, double max_m = 10) noexcept {
  return number_param("position_sigma_m", "m", sigma_m, 0, max_m, doc);
}

/// The parameter `heading_sigma_deg`.
constexpr ParamSpec heading_sigma(double sigma_deg, const char* doc) noexcept {
  return number_param("heading_sigma_deg", "deg", sigma_deg, 0, 180, doc);
}

/// The variances from the two parameters.
[[nodiscard]] constexpr Doubt read_doubt(const Params& params) noexcept {
  const double position_m = params.number("position_sigma_m");
  const double heading_rad = deg_to_rad(params.number("heading_sigma_deg"));
  return {position_m * position_m, heading_rad * heading_rad};
}

}  // namespace rave::pose_doubt
