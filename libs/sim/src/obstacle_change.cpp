// SPDX-License-Identifier: Apache-2.0
// Changes of obstacles come from files, people and other processes. What is wrong by itself is
// found here; whether there is room is up to the world.
#include "rave/sim/obstacle_change.hpp"

#include <cmath>

#include "rave/base/control_characters.hpp"
#include "rave/math/finite.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {
namespace {

using Kind = ObstacleChange::Kind;

Status check_name(const ObstacleChange& change) {
  const std::string& name = change.name;
  // Of what is changed, the number is enough.
  if (name.empty() && change.kind != Kind::kAdd && change.id.valid()) return {};
  if (name.empty()) return fail(ErrorCode::kInvalidArgument, "an obstacle needs a name");
  if (name.size() > ObstacleChange::kMostNameBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "the name of an obstacle has {} bytes; expected at most {}", name.size(),
                ObstacleChange::kMostNameBytes);
  }
  if (has_control_characters(name)) {
    return fail(ErrorCode::kInvalidArgument, "the name of an obstacle has a control character");
  }
  return {};
}

Status check_number(const ObstacleChange& change, std::string_view what, double value, double most,
                    std::string_view unit) {
  // Not a number compares false and is refused with the rest.
  if (std::abs(value) <= most) return {};
  return fail(ErrorCode::kInvalidArgument, "obstacle `{}`: {} is {}; expected within +-{} {}",
              change.name, what, value, most, unit);
}

Status check_pose(const ObstacleChange& change) {
  const Pose2& X_WB = change.X_WB;
  RAVE_TRY(check_number(change, "x", X_WB.x, ObstacleChange::kFarthest_m, "m"));
  RAVE_TRY(check_number(change, "y", X_WB.y, ObstacleChange::kFarthest_m, "m"));
  return check_number(change, "yaw", X_WB.yaw, ObstacleChange::kMostTurn_rad, "rad");
}

Status check_shape(const ObstacleChange& change, const world::Shape& shape) {
  const auto wrong = [&change](std::string_view what) {
    return fail(ErrorCode::kInvalidArgument, "obstacle `{}`: {}", change.name, what);
  };
  if (!(std::isfinite(shape.z0_m) && std::isfinite(shape.z1_m) && shape.z0_m < shape.z1_m)) {
    return wrong("a height range whose low end is not below its high end");
  }
  // A polygon that exists is convex, and all its numbers are finite.
  if (shape.kind == world::ShapeKind::kPolygon) {
    return shape.polygon ? Status{} : wrong("a polygon without corners");
  }
  if (shape.kind != world::ShapeKind::kDisc || shape.polygon) return wrong("an unknown shape");
  if (!(is_finite(shape.centre) && std::isfinite(shape.radius_m) && shape.radius_m > 0)) {
    return wrong("a disc that needs a finite centre and a radius above 0");
  }
  return {};
}

Status check_body(const ObstacleChange& change) {
  const world::Body& body = change.body;
  const auto wrong = [&change](std::string_view what) {
    return fail(ErrorCode::kInvalidArgument, "obstacle `{}`: {}", change.name, what);
  };
  if (body.shapes.empty() || body.shapes.size() > ObstacleChange::kMostShapes) {
    return fail(ErrorCode::kInvalidArgument, "obstacle `{}` has {} convex shapes; expected 1 to {}",
                change.name, body.shapes.size(), ObstacleChange::kMostShapes);
  }
  for (const world::Shape& shape : body.shapes) RAVE_TRY(check_shape(change, shape));
  if (!(body.radius_m() <= ObstacleChange::kLargest_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "obstacle `{}` reaches {} m from its origin; expected at most {} m", change.name,
                body.radius_m(), ObstacleChange::kLargest_m);
  }
  // An obstacle on a layer of robots would be sensed as one.
  if (body.layer != Layer::kVirtualObstacles && body.layer != Layer::kMappedReal) {
    return wrong("its layer is one of robots; expected `virtual_obstacles` or `mapped_real`");
  }
  if (body.colour.size() > ObstacleChange::kMostColourBytes) return wrong("an unknown colour");
  if (body.code && !(std::isfinite(body.code_z0_m) && std::isfinite(body.code_z1_m))) {
    return wrong("a code at a height that is not a number");
  }
  return {};
}

EventKind kind_of(ObstacleChange::Kind kind) noexcept {
  if (kind == ObstacleChange::Kind::kAdd) return EventKind::kObstacleAdded;
  return kind == ObstacleChange::Kind::kMove ? EventKind::kObstacleMoved
                                             : EventKind::kObstacleRemoved;
}

}  // namespace

Event obstacle_event(std::uint64_t step, const ObstacleChange& change, std::string_view note,
                     const Author& author) {
  const Pose2& X_WB = change.X_WB;
  std::string text = fmt::format("`{}`", change.name);
  if (change.kind != Kind::kRemove) {
    // All digits, because the text of this event is part of the run hash.
    text += fmt::format(" at ({}, {}), yaw {} rad", X_WB.x, X_WB.y, X_WB.yaw);
  }
  text += note;
  if (author.by_hand) text += fmt::format(" ({})", by_hand_text(author));
  return {step, RobotId(), kind_of(change.kind), change.id, std::move(text)};
}

Status check_obstacle_change(const ObstacleChange& change) {
  if (change.kind > Kind::kRemove) {
    return fail(ErrorCode::kInvalidArgument, "the kind of the obstacle change is unknown");
  }
  RAVE_TRY(check_name(change));
  if (change.asked.size() > ObstacleChange::kMostAskedBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "obstacle `{}`: request of {} bytes; expected at most {}", change.name,
                change.asked.size(), ObstacleChange::kMostAskedBytes);
  }
  if (change.kind == Kind::kRemove) return {};
  RAVE_TRY(check_pose(change));
  return change.kind == Kind::kAdd ? check_body(change) : Status{};
}

}  // namespace rave::sim
