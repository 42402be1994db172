// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/robot/processing.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave::sim {

/// Refuses a fan that cannot be cast. Error: kPlugin.
[[nodiscard]] inline Status check_fan(const VirtualDeclaration& declaration, ReadingKind kind) {
  const FanQuery& fan = declaration.fan;
  if (kind == ReadingKind::kRanges && fan.rays_per_reading > 0 && fan.ray_count > 0 &&
      fan.ray_count % fan.rays_per_reading == 0) {
    return {};
  }
  return fail(ErrorCode::kPlugin, "declared a fan of {} rays, {} per reading, for {}",
              fan.ray_count, fan.rays_per_reading, to_string(kind));
}

/// Fills in what a declared fan says of the sensor.
inline void describe_fan(const VirtualDeclaration& declaration, SensorInfo& info) {
  info.range_min_m = declaration.fan.range_min_m;
  info.range_max_m = declaration.fan.range_max_m;
  info.bearings_rad = declaration.reading_bearings_rad != nullptr ? declaration.reading_bearings_rad
                                                                  : declaration.fan.bearings_rad;
  info.cone_rad = declaration.cone_rad;
}

/// How far a range sensor measures; no limit where its driver does not say it.
[[nodiscard]] inline rave::RangeLimits range_limits_of(const SensorInfo& info) noexcept {
  if (!(info.range_max_m > 0)) return {};
  return {info.range_min_m, info.range_max_m};
}

}  // namespace rave::sim
