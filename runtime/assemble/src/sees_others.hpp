// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Whether robots of a type need the poses of others.
[[nodiscard]] inline bool sees_others(const sim::RobotType& type) {
  const auto looks = [](const sim::SensorSpec& sensor) {
    return sensor.virtual_ops != nullptr || sensor.hybrid.has_value();
  };
  return std::any_of(type.sensors.begin(), type.sensors.end(), looks) ||
         (type.guard && type.guard->separation_m >= 0);
}

}  // namespace rave::runtime
