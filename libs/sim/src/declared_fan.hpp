// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin_call.hpp"
#include "rave/base/result.hpp"
#include "rave/robot/processing.hpp"
#include "rave/sim/virtual_sensor.hpp"

namespace rave::sim {

/// Asks a virtual sensor for its declaration, and fills in what it says of the sensor. Error:
/// kPlugin, also for a fan that cannot be cast.
[[nodiscard]] inline Result<VirtualDeclaration> declaration_of(const VirtualSensorOps& ops,
                                                               void* instance,
                                                               const VirtualSensorSetup& setup,
                                                               ReadingKind kind, SensorInfo& info) {
  VirtualDeclaration declaration;
  RAVE_TRY(called(
      [&](ErrorText* error) { return ops.configure(instance, &setup, &declaration, error); }));
  info.capacity = declaration.capacity;
  if (declaration.uses_fan == 0) return declaration;
  const FanQuery& fan = declaration.fan;
  if (kind != ReadingKind::kRanges || fan.rays_per_reading == 0 || fan.ray_count == 0 ||
      fan.ray_count % fan.rays_per_reading != 0) {
    return fail(ErrorCode::kPlugin, "declared a fan of {} rays, {} per reading, for {}",
                fan.ray_count, fan.rays_per_reading, to_string(kind));
  }
  info.capacity = fan.ray_count / fan.rays_per_reading;
  info.range_min_m = fan.range_min_m;
  info.range_max_m = fan.range_max_m;
  info.bearings_rad = declaration.reading_bearings_rad != nullptr ? declaration.reading_bearings_rad
                                                                  : fan.bearings_rad;
  info.cone_rad = declaration.cone_rad;
  return declaration;
}

/// How far a range sensor measures; no limit where its driver does not say it.
[[nodiscard]] inline rave::RangeLimits range_limits_of(const SensorInfo& info) noexcept {
  if (!(info.range_max_m > 0)) return {};
  return {info.range_min_m, info.range_max_m};
}

}  // namespace rave::sim
