// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "fuse_drivers.hpp"

namespace rave::sim::testing {

inline constexpr float kNothing = std::numeric_limits<float>::infinity();

inline ObstacleChange add(const std::string& name, const Pose2& X_WB, double length_m = 0.2,
                          double width_m = 1) {
  ObstacleChange change;
  change.name = name;
  change.X_WB = X_WB;
  change.body = box({}, length_m, width_m).body;
  return change;
}
inline ObstacleChange move(const std::string& name, const Pose2& X_WB) {
  ObstacleChange change;
  change.kind = ObstacleChange::Kind::kMove;
  change.name = name;
  change.X_WB = X_WB;
  return change;
}
inline ObstacleChange take_away(const std::string& name) {
  ObstacleChange change;
  change.kind = ObstacleChange::Kind::kRemove;
  change.name = name;
  return change;
}

/// One robot that looks ahead and stands, one that drives ahead beside it.
inline EngineSpec looker_and_driver() {
  EngineSpec spec;
  spec.history = from_seconds(0.2);
  spec.world.obstacles.push_back(box({8, 0, 0}, 0.2, 1, 1, "post"));
  RobotType looker = simulated_type();
  looker.sensors.push_back(laser(1, 0, 5));
  add_robot(spec, std::move(looker));
  RobotType driver = simulated_type();
  driver.program = program<Drive>({{"v", 0.5}});
  add_robot(spec, std::move(driver), {0, 5, 0});
  return spec;
}
inline constexpr RobotId kLooker(0);
inline constexpr RobotId kDriver(1);

inline std::uint32_t seen(const Engine& engine) { return engine.sensor(kLooker, 0).bodies[0]; }

}  // namespace rave::sim::testing
