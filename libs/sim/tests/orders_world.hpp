// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/sim_testing/order_programs.hpp"

/// A small world in which orders are given.
namespace rave::sim::testing {

inline EngineSpec small_world() {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({4, 0, 0}, 0.2, 4, 1, "wall"));
  add_robot(spec, listener_type(), {0, 0, 0});
  add_robot(spec, driver_type(), {0, 2, 0});
  add_robot(spec, goal_type(), {0, -2, 0});
  return spec;
}

inline constexpr RobotId kListener(0);
inline constexpr RobotId kDriver(1);
inline constexpr RobotId kGoalGetter(2);

inline std::string why(const Status& status) { return status ? "" : status.error().message; }

}  // namespace rave::sim::testing
