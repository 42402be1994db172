// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go while a run goes.
#include <algorithm>

#include "rave/base/names.hpp"
#include "rave/world/touching.hpp"
#include "world_truth.hpp"

namespace rave::sim {
namespace {

using Kind = ObstacleChange::Kind;

/// Calls `visit(id, obstacle)` for each obstacle that stands.
template <class Visit>
void for_each_standing(const world::WorldModel& world, Visit&& visit) {
  for (std::size_t i = 0; i < world.obstacle_count(); ++i) {
    const std::uint32_t id = world.obstacle_id(i);
    const world::Obstacle& obstacle = *world.obstacle(id);
    if (!obstacle.removed) visit(id, obstacle);
  }
}

Error unknown_obstacle(const world::WorldModel& world, const std::string& name) {
  std::vector<std::string_view> names;
  for_each_standing(world, [&](std::uint32_t, const world::Obstacle& obstacle) {
    names.emplace_back(obstacle.body.name);
  });
  // A message with all of the thousands of walls of a map helps no user.
  constexpr std::size_t kMany = 12;
  const bool list = names.size() <= kMany || !nearest_name(name, names).empty();
  return {ErrorCode::kNotFound,
          fmt::format("there is no obstacle `{}`{}", name,
                      list ? suggestion(name, names) : fmt::format("; there are {}", names.size())),
          {}};
}

}  // namespace

Result<BodyId> WorldTruth::find_obstacle(const ObstacleChange& change) const {
  const world::WorldModel& world = spec.world;
  // Two obstacles may have one name, as in maps; a number is always one of them.
  if (change.id.valid()) {
    const world::Obstacle* const obstacle = world.obstacle(change.id.value());
    if (obstacle != nullptr && !obstacle->removed) return change.id;
    return fail(ErrorCode::kNotFound, "there is no obstacle {}{}", change.id.value(),
                obstacle != nullptr ? fmt::format("; `{}` has been removed", obstacle->body.name)
                                    : std::string());
  }
  BodyId found;
  std::size_t count = 0;
  for_each_standing(world, [&](std::uint32_t id, const world::Obstacle& obstacle) {
    if (obstacle.body.name != change.name) return;
    if (count++ == 0) found = BodyId(id);
  });
  if (count == 0) return tl::unexpected(unknown_obstacle(world, change.name));
  if (count == 1) return found;
  return fail(ErrorCode::kInvalidArgument,
              "{1} obstacles are named `{0}`; give the number of one instead", change.name, count);
}

Status WorldTruth::check_new_obstacle(const ObstacleChange& change) const {
  std::size_t standing = 0;
  BodyId same;
  const std::string* same_code = nullptr;
  for (const world::Body& robot : spec.world.robots) {
    if (robot.code == change.body.code) same_code = &robot.name;
  }
  for_each_standing(spec.world, [&](std::uint32_t id, const world::Obstacle& obstacle) {
    ++standing;
    if (obstacle.body.name == change.name) same = BodyId(id);
    if (obstacle.body.code == change.body.code) same_code = &obstacle.body.name;
  });
  if (same.valid()) {
    return fail(ErrorCode::kInvalidArgument,
                "there already is an obstacle `{}` (number {}); move it, or choose another name",
                change.name, same.value());
  }
  // Sensors tell landmarks by their codes alone, so two of the same code could not be
  // distinguished.
  if (change.body.code && same_code != nullptr) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` already carries the code {}; expected another code for the obstacle `{}`",
                *same_code, *change.body.code, change.name);
  }
  if (standing >= ObstacleChange::kMostStanding) {
    return fail(ErrorCode::kInvalidArgument, "there are {} obstacles, which is the maximum",
                standing);
  }
  if (spec.world.added.size() >= ObstacleChange::kMostAdded) {
    return fail(ErrorCode::kInvalidArgument,
                "{} obstacles were added in this run, which is the maximum",
                spec.world.added.size());
  }
  return {};
}

/// Obstacles do not push: what would overlap a simulated robot is refused, unless it overlaps it no
/// deeper than before. Real robots are only told about.
Status WorldTruth::check_room_for(const ObstacleChange& change, const world::Body& body,
                                  std::string& note) const {
  const double own_m = body.radius_m();
  for (std::uint32_t r = 0; r < movers.size(); ++r) {
    if (!movers[r].present) continue;
    const double reach_m = own_m + radius_m[r] + kApart_m;
    const Vec2 apart = movers[r].X_WR.position() - change.X_WB.position();
    if (squared_norm(apart) > reach_m * reach_m) continue;
    const world::Body& robot = spec.world.robots[r];
    const double gap_m = world::separation(body, change.X_WB, robot, movers[r].X_WR).distance_m;
    if (gap_m >= kApart_m) continue;
    if (!movers[r].simulated) {
      if (gap_m < 0) note += fmt::format(", over the real robot `{}`", spec.robots[r].name);
      continue;
    }
    if (change.kind == Kind::kMove) {
      const Pose2& X_before = spec.world.obstacle(change.id.value())->X_WB;
      if (gap_m >= world::separation(body, X_before, robot, movers[r].X_WR).distance_m) continue;
    }
    return fail(ErrorCode::kInvalidArgument,
                "obstacle `{}` would overlap the robot `{}` at ({:.3f}, {:.3f}); an obstacle does "
                "not push robots away, so put it elsewhere",
                change.name, spec.robots[r].name, movers[r].X_WR.x, movers[r].X_WR.y);
  }
  return {};
}

Result<ObstacleChange> WorldTruth::change_obstacle(ObstacleChange change, SimTime from,
                                                   std::string& note) {
  RAVE_TRY(check_obstacle_change(change));
  if (change.kind == Kind::kAdd) {
    RAVE_TRY(check_new_obstacle(change));
    RAVE_TRY(check_room_for(change, change.body, note));
    // Numbers are never used again, so a recording or a late host cannot mistake one obstacle for
    // another.
    change.id = BodyId(spec.world.body_count());
  } else {
    RAVE_TRY_ASSIGN(change.id, find_obstacle(change));
    const world::Body& body = spec.world.body(change.id.value());
    change.name = body.name;
    if (change.kind == Kind::kMove) RAVE_TRY(check_room_for(change, body, note));
  }
  put_obstacles({&change, 1}, from);
  return change;
}

void WorldTruth::put_obstacles(std::span<const ObstacleChange> changes, SimTime from,
                               const std::function<void(const ObstacleChange&)>& placed) {
  if (changes.empty()) return;
  for (const ObstacleChange& change : changes) {
    place_obstacle(change, from);
    if (placed) placed(change);
  }
  // Once for all: it builds the grid of everything that stands.
  snapshot.index_obstacles();
}

/// Where it stands, for everybody but the index of the snapshot.
void WorldTruth::place_obstacle(const ObstacleChange& change, SimTime from) {
  world::WorldModel& world = spec.world;
  ObstacleState before;
  if (change.kind == Kind::kAdd) {
    world.added.push_back({change.body, change.X_WB, false});
    world.added.back().body.name = change.name;
    snapshot.obstacle_added();
    before.X_WB = change.X_WB;
  }
  world::Obstacle& obstacle = *world.obstacle(change.id.value());
  if (change.kind != Kind::kAdd) before = {obstacle.X_WB, true};
  if (change.id.value() < world.obstacles.size()) {
    original_places_.try_emplace(change.id.value(), obstacle.X_WB);
  }
  if (change.kind == Kind::kMove) obstacle.X_WB = change.X_WB;
  obstacle.removed = change.kind == Kind::kRemove;
  snapshot.set_obstacle(change.id, obstacle.X_WB, !obstacle.removed);
  // The oldest frame of the history may be a step older than the history is long.
  journal.forget_before(from - spec.history - Duration{2 * spec.step.ns});
  journal.add({from, change.id, before, {obstacle.X_WB, !obstacle.removed}});
}

bool WorldTruth::restore_obstacles() {
  world::WorldModel& world = spec.world;
  if (original_places_.empty() && world.added.empty()) return false;
  if (!world.added.empty()) {
    // First, since the numbers of the added ones are the last ones; what remains keeps its place.
    world.added.clear();
    snapshot.added_dropped();
  }
  for (const auto& [id, X_WB] : original_places_) {
    world.obstacles[id].X_WB = X_WB;
    world.obstacles[id].removed = false;
    snapshot.set_obstacle(BodyId(id), X_WB, true);
  }
  original_places_.clear();
  snapshot.index_obstacles();
  journal.clear();
  return true;
}

}  // namespace rave::sim
