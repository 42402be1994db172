// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "rave/base/hash.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::sim {

/// What an authority knows beside the last WorldStep that it made. With both another one can go on
/// in its place, to the bit.
struct AuthorityState {
  static constexpr std::size_t kMostRefused = 64;
  RunHash hash;                      ///< With what has been noted in the step of the world.
  std::vector<Event> events;         ///< Noted so far in that step; their texts do not matter.
  std::vector<RobotId> pinned;       ///< Who could not get out of a real robot's way; ascending.
  std::vector<ResizedRobot> scales;  ///< Of all bodies that are not as the spec says; ascending.
  std::uint64_t inputs = 0;          ///< How many have been asked for so far.
  /// How many changes of obstacles were made before those of the world.
  std::uint64_t obstacle_changes = 0;
  /// What leads from the obstacles of the spec to those before the world, see ObstacleHistory.
  /// Left out (empty although there were changes) where everybody knows them.
  std::vector<ObstacleChange> obstacles;
  /// How many changes of the scenario could not be made in all steps so far, and the first of them:
  /// EventKind::kChangeRefused, in order.
  std::uint64_t refused_count = 0;
  std::vector<Event> refused;
  /// Contacts and pins of the step before that of the world, which is done: for hosts, so that
  /// these are known when the authority is gone. Another one does not need them to go on.
  std::vector<Event> done;
};

/// The text of pins, EventKind::kPinned.
inline constexpr std::string_view kPinnedText = "cannot get out of the way";

/// The event of a body that has another size from `step` on; `before`: its scale until then.
[[nodiscard]] Event resized_event(std::uint64_t step, const ResizedRobot& robot, double before,
                                  bool by_hand);

}  // namespace rave::sim
