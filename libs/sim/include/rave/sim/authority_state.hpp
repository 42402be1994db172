// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/base/hash.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::sim {

/// What an authority knows beside the last WorldStep that it made. With both another one can go on
/// in its place, to the bit.
struct AuthorityState {
  RunHash hash;                      ///< With what has been noted in the step of the world.
  std::vector<Event> events;         ///< Noted so far in that step; their texts do not matter.
  std::vector<RobotId> pinned;       ///< Who could not get out of a real robot's way; ascending.
  std::vector<ResizedRobot> scales;  ///< Of all bodies that are not as the spec says; ascending.
  std::uint64_t inputs = 0;          ///< How many have been asked for so far.
  /// All changes of obstacles so far, in their order; those of the world are the last of them.
  std::vector<ObstacleChange> obstacles;
};

}  // namespace rave::sim
