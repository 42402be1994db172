// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/obstacles.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/names.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::runtime {
namespace {

using Kind = sim::ObstacleChange::Kind;

std::vector<Vec2> corners_of(const config::Outline& outline) {
  std::vector<Vec2> corners;
  if (outline.box_m) {
    const double x = (*outline.box_m)[0] / 2;
    const double y = (*outline.box_m)[1] / 2;
    // Counterclockwise, as all polygons of the world.
    corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  } else if (outline.polygon_m) {
    for (const auto& [x, y] : *outline.polygon_m) corners.push_back({x, y});
  }
  return corners;
}

Pose2 pose_of(double x_m, double y_m, double yaw_deg) {
  return {x_m, y_m, wrap_angle(deg_to_rad(yaw_deg))};
}

}  // namespace

Result<std::vector<world::Shape>> shapes_of(const config::Outline& outline, const Pose2& X_BO,
                                            const config::HeightRange& z_m) {
  if (outline.disc_radius_m) {
    RAVE_TRY_ASSIGN(auto disc,
                    world::make_disc(X_BO.position(), *outline.disc_radius_m, z_m[0], z_m[1]));
    return std::vector<world::Shape>{std::move(disc)};
  }
  std::vector<Vec2> corners = corners_of(outline);
  for (Vec2& corner : corners) corner = transform(X_BO, corner);
  // A polygon that is not convex becomes several convex pieces.
  return world::make_prisms(corners, z_m[0], z_m[1]);
}

Layer layer_of(config::ObstacleLayer layer) {
  return layer == config::ObstacleLayer::kMappedReal ? Layer::kMappedReal
                                                     : Layer::kVirtualObstacles;
}

Result<world::Obstacle> make_obstacle(const config::ObstacleFile& file) {
  world::Obstacle obstacle;
  obstacle.body.name = file.name.value;
  obstacle.body.layer = layer_of(file.layer);
  obstacle.body.colour = file.colour.value_or("");
  obstacle.X_WB = pose_of(file.x_m, file.y_m, file.yaw_deg);
  auto shapes = shapes_of(file.outline, {}, file.z_m);
  if (!shapes) {
    return fail_at(file.name.where, ErrorCode::kInvalidArgument, "obstacle `{}`: {}",
                   file.name.value, shapes.error().message);
  }
  obstacle.body.shapes = *std::move(shapes);
  if (file.barcode) {
    const config::HeightRange code_z_m = file.barcode_z_m.value_or(file.z_m);
    obstacle.body.code = *file.barcode;
    obstacle.body.code_z0_m = code_z_m[0];
    obstacle.body.code_z1_m = code_z_m[1];
  }
  return obstacle;
}

Result<sim::ObstacleChange> change_of(const config::ObstacleEdit& edit) {
  sim::ObstacleChange change;
  change.name = edit.name().value;
  if (edit.remove_obstacle) {
    change.kind = Kind::kRemove;
  } else if (edit.move_obstacle) {
    change.kind = Kind::kMove;
    change.X_WB =
        pose_of(edit.move_obstacle->x_m, edit.move_obstacle->y_m, edit.move_obstacle->yaw_deg);
  } else {
    RAVE_TRY_ASSIGN(world::Obstacle obstacle, make_obstacle(*edit.add_obstacle));
    change.X_WB = obstacle.X_WB;
    change.body = std::move(obstacle.body);
  }
  return change;
}

Status add_obstacle_changes(const config::ExpandedScenario& scenario, sim::EngineSpec& spec) {
  // Names of the world at the start and of all additions. Whether an obstacle exists at the time of
  // a change is known only in the run, because another change or a person may remove it; then the
  // change is refused with an event.
  std::vector<std::string_view> names;
  for (const world::Obstacle& obstacle : spec.world.obstacles) {
    names.emplace_back(obstacle.body.name);
  }
  for (const config::ChangeFile& file : scenario.scenario.changes) {
    const auto& added = file.obstacle.add_obstacle;
    if (added) names.emplace_back(*added->name);
  }
  for (const config::ChangeFile& file : scenario.scenario.changes) {
    if (!file.changes_obstacle()) continue;
    const codec::Located<std::string>& name = file.obstacle.name();
    if (std::find(names.begin(), names.end(), *name) == names.end()) {
      return fail_at(name.where, ErrorCode::kNotFound, "there is no obstacle `{}`{}", *name,
                     suggestion(*name, names));
    }
    sim::ScheduledObstacle scheduled;
    RAVE_TRY_ASSIGN(scheduled.change, change_of(file.obstacle));
    // The same check as for requests of a run in progress, so a scenario cannot contain what a
    // request may not ask.
    const Status checked = sim::check_obstacle_change(scheduled.change);
    if (!checked) return fail_at(name.where, checked.error().code, "{}", checked.error().message);
    if (!file.is_scheduled()) continue;
    scheduled.step =
        static_cast<std::uint64_t>(std::llround(**file.at_s / scenario.scenario.step_s.value));
    spec.obstacle_changes.push_back(std::move(scheduled));
  }
  std::stable_sort(spec.obstacle_changes.begin(), spec.obstacle_changes.end(),
                   [](const auto& a, const auto& b) { return a.step < b.step; });
  return {};
}

std::string list_obstacles(const world::WorldModel& world) {
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = 0; i < world.obstacle_count(); ++i) {
    const std::uint32_t id = world.obstacle_id(i);
    const world::Obstacle& obstacle = *world.obstacle(id);
    // A removed obstacle keeps its number, so that numbers in recordings stay unique.
    if (obstacle.removed) continue;
    ++count;
    text += fmt::format("\n{:>6}  {:<24} {:<18} ({:.3f}, {:.3f}) m, {:.1f} deg", id,
                        obstacle.body.name, to_string(obstacle.body.layer), obstacle.X_WB.x,
                        obstacle.X_WB.y, rad_to_deg(obstacle.X_WB.yaw));
  }
  return fmt::format("{} obstacle{}{}", count, count == 1 ? "" : "s", text);
}

}  // namespace rave::runtime
