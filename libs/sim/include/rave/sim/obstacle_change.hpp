// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/world/body.hpp"
#include "rave/world/world_view.hpp"

namespace rave::sim {

struct Author;
struct Event;

/// A request to add, move or remove an obstacle, or such a change after it was made. Obstacles
/// never push: a pose that would overlap a simulated robot is refused. Obstacles may overlap real
/// robots.
struct ObstacleChange {
  enum class Kind : std::uint8_t { kAdd, kMove, kRemove };

  static constexpr std::size_t kMostNameBytes = 64;
  static constexpr std::size_t kMostColourBytes = 32;
  static constexpr std::size_t kMostShapes = 64;  ///< Each with at most 64 corners.
  static constexpr double kFarthest_m = 1e7;      ///< Limit of the coordinates of the pose.
  static constexpr double kMostTurn_rad = 1e6;
  /// Limit of the distance from the body's origin to its farthest point.
  static constexpr double kLargest_m = 1e6;
  static constexpr std::size_t kMostStanding = 100'000;  ///< Obstacles that exist at one time.
  /// Obstacles added in one run, removed ones included.
  static constexpr std::size_t kMostAdded = 100'000;
  static constexpr std::size_t kMostAskedBytes = 4096;

  Kind kind = Kind::kAdd;
  /// kMove and kRemove: the obstacle; if none, the one called `name`. kAdd: assigned by the world;
  /// none in a request.
  BodyId id;
  /// 1 to kMostNameBytes bytes without control characters; unique among the existing obstacles.
  std::string name;
  Pose2 X_WB;        ///< kAdd and kMove.
  world::Body body;  ///< kAdd: shapes, layer, barcode and colour; its name becomes `name`.
  /// The edit of a request by hand as recordings have it, for those of all hosts; at most
  /// kMostAskedBytes. Empty: the change is part of the run.
  std::string asked;
  std::string by{};  ///< Name of the user who requested it; empty: none.
};

/// The result of a change.
struct ChangedObstacle {
  BodyId id;
  std::uint64_t step = 0;  ///< The first step that shows it.
  std::string text;        ///< Description for people, as in the event of that step.
};

/// A change that is part of the run. It is made before step `step` senses, and before parameter
/// changes of that step.
struct ScheduledObstacle {
  std::uint64_t step = 0;
  ObstacleChange change;
};

/// The event of a change that takes effect at `step`. `note`: an additional remark for its text.
[[nodiscard]] Event obstacle_event(std::uint64_t step, const ObstacleChange& change,
                                   std::string_view note, const Author& author);

/// Checks a change without reference to a world: finite numbers within the limits above; for a new
/// obstacle shapes of positive size and the layer of an obstacle. Errors: kInvalidArgument.
Status check_obstacle_change(const ObstacleChange& change);

}  // namespace rave::sim
