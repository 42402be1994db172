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

/// A wish to change which obstacles there are, or what became of one. Obstacles do not push: a new
/// place that would overlap a simulated robot is refused. A real robot stands where it stands, and
/// obstacles may be put over it.
struct ObstacleChange {
  enum class Kind : std::uint8_t { kAdd, kMove, kRemove };

  static constexpr std::size_t kMostNameBytes = 64;
  static constexpr std::size_t kMostColourBytes = 32;
  static constexpr std::size_t kMostShapes = 64;  ///< Each of at most 64 corners.
  static constexpr double kFarthest_m = 1e7;      ///< Coordinates of the pose.
  static constexpr double kMostTurn_rad = 1e6;
  /// From the body's origin to its farthest point.
  static constexpr double kLargest_m = 1e6;
  static constexpr std::size_t kMostStanding = 100'000;  ///< Obstacles of a world at a time.
  static constexpr std::size_t kMostAdded = 100'000;     ///< In one run, removed ones too.
  static constexpr std::size_t kMostAskedBytes = 4096;

  Kind kind = Kind::kAdd;
  /// Of kMove and kRemove: which one; with none, the one that `name` says. Of kAdd it is given by
  /// the world: none when it is asked for.
  BodyId id;
  /// 1 to kMostNameBytes bytes without control characters; unique among the obstacles that stand.
  std::string name;
  Pose2 X_WB;        ///< kAdd and kMove.
  world::Body body;  ///< kAdd: shapes, layer, code and colour; it will be called `name`.
  /// In the words of whoever asked for it by hand, for records on all hosts; at most
  /// kMostAskedBytes. Empty: it belongs to the run.
  std::string asked;
  std::string by{};  ///< Who that was, if it has a name.
};

/// What became of a change that was made.
struct ChangedObstacle {
  BodyId id;
  std::uint64_t step = 0;  ///< The first that shows it.
  std::string text;        ///< For people, as the event of that step has it.
};

/// A change that belongs to the run: made before the step `step` senses, before parameters change
/// in the same step.
struct ScheduledObstacle {
  std::uint64_t step = 0;
  ObstacleChange change;
};

/// The event of a change that was made and counts from `step` on. `note`: what else is worth
/// telling.
[[nodiscard]] Event obstacle_event(std::uint64_t step, const ObstacleChange& change,
                                   std::string_view note, const Author& author);

/// What can be seen without a world: numbers are finite and within the limits above, the body of a
/// new obstacle has shapes of positive size and an obstacle's layer. Errors: kInvalidArgument.
Status check_obstacle_change(const ObstacleChange& change);

}  // namespace rave::sim
