// SPDX-License-Identifier: Apache-2.0
#include "hybrid_pose.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "rave/math/scalar.hpp"

namespace rave {
namespace {

double checked(double variance, const char* half, const char* parameter) {
  if (std::isfinite(variance) && variance > 0) return variance;
  // fuse() returns nothing; the interface of plug-ins catches exceptions and reports the driver as
  // failed.
  throw std::runtime_error(
      fmt::format("a reading of the {0} half has the variance {1}, so it cannot be weighted: "
                  "expected `{0}_{2}` above 0 in the parameters",
                  half, variance, parameter));
}

}  // namespace

Status HybridPose::start(const HybridSetup& setup) {
  const Params params = setup.parameters();
  const auto squared = [&](const char* name, double unit) {
    const double sigma = unit * params.number(name);
    return sigma * sigma;
  };
  real_.xy_m2 = squared("real_sigma_xy_m", 1);
  real_.yaw_rad2 = squared("real_sigma_yaw_deg", deg_to_rad(1));
  imagined_.xy_m2 = squared("virtual_sigma_xy_m", 1);
  imagined_.yaw_rad2 = squared("virtual_sigma_yaw_deg", deg_to_rad(1));
  return {};
}

PoseReading HybridPose::with_variance(const PoseReading& reading, const Stated& stated) {
  PoseReading pose = reading;
  if (stated.xy_m2 > 0) pose.variance_xy_m2 = stated.xy_m2;
  if (stated.yaw_rad2 > 0) pose.variance_yaw_rad2 = stated.yaw_rad2;
  pose.variance_xy_m2 = checked(pose.variance_xy_m2, stated.half, "sigma_xy_m");
  pose.variance_yaw_rad2 = checked(pose.variance_yaw_rad2, stated.half, "sigma_yaw_deg");
  return pose;
}

void HybridPose::fuse(const FuseItem& item) const {
  auto& result = *static_cast<PoseReading*>(item.result_records);
  const bool has_real = item.real->count > 0;
  const bool has_imagined = item.imagined->count > 0;
  item.result->count = has_real || has_imagined ? 1 : 0;
  if (item.result->count == 0) return;
  PoseReading real;
  PoseReading imagined;
  if (has_real) {
    real = with_variance(*static_cast<const PoseReading*>(item.real_records), real_);
  }
  if (has_imagined) {
    imagined = with_variance(*static_cast<const PoseReading*>(item.imagined_records), imagined_);
  }
  if (!has_real || !has_imagined) {
    result = has_real ? real : imagined;
    return;
  }
  // The minimum-variance mean of two independent measurements: each is weighted by the variance of
  // the other, and the result has the variance a b / (a + b).
  const double sum_m2 = real.variance_xy_m2 + imagined.variance_xy_m2;
  const double sum_rad2 = real.variance_yaw_rad2 + imagined.variance_yaw_rad2;
  const double share_xy = real.variance_xy_m2 / sum_m2;
  const double share_yaw = real.variance_yaw_rad2 / sum_rad2;
  result.x_m = real.x_m + share_xy * (imagined.x_m - real.x_m);
  result.y_m = real.y_m + share_xy * (imagined.y_m - real.y_m);
  // Headings are averaged along the shorter turn, or two headings near pi would meet near 0.
  const double turn_rad = wrap_angle(imagined.yaw_rad - real.yaw_rad);
  result.yaw_rad = wrap_angle(real.yaw_rad + share_yaw * turn_rad);
  result.variance_xy_m2 = share_xy * imagined.variance_xy_m2;
  result.variance_yaw_rad2 = share_yaw * imagined.variance_yaw_rad2;
}

}  // namespace rave
