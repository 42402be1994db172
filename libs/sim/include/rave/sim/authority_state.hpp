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

/// The state of a world authority besides the last WorldStep that it made. With both, another
/// authority can continue, bit by bit.
struct AuthorityState {
  static constexpr std::size_t kMostRefused = 64;
  RunHash hash;               ///< Includes what was noted in the step of the world.
  std::vector<Event> events;  ///< Events noted in that step so far; their texts are not used.
  /// Simulated robots that cannot get out of a real robot's way; ascending.
  std::vector<RobotId> pinned;
  std::vector<ResizedRobot> scales;  ///< Scales of all bodies that differ from the spec; ascending.
  std::uint64_t inputs = 0;          ///< Number of inputs so far.
  /// Number of obstacle changes before those of the world.
  std::uint64_t obstacle_changes = 0;
  /// The changes from the obstacles of the spec to those before the world, see ObstacleHistory.
  /// Omitted (empty although there were changes) where all hosts know them.
  std::vector<ObstacleChange> obstacles;
  /// Number of scenario changes that failed so far, and the first of them:
  /// EventKind::kChangeRefused, in order.
  std::uint64_t refused_count = 0;
  std::vector<Event> refused;
  std::vector<std::byte> conductor;  ///< Conductor::state() after that step; empty: there is none.
  /// Contacts and pins of the completed step before that of the world. Hosts use them if the
  /// authority is lost; another authority does not need them.
  std::vector<Event> done;
};

/// The text of EventKind::kPinned.
inline constexpr std::string_view kPinnedText = "cannot get out of the way";

/// The event of a body whose scale changes at `step`; `before`: its previous scale.
[[nodiscard]] Event resized_event(std::uint64_t step, const ResizedRobot& robot, double before,
                                  bool by_hand);

}  // namespace rave::sim
