// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "rave/base/names.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/placed_shape.hpp"

namespace rave::runtime {
namespace {

/// The largest robot that a person has meant, in radius.
constexpr double kHuge_m = 20;

bool contains(const world::Obstacle& obstacle, Vec2 p_W) {
  const Vec2 p_B = transform_back(obstacle.X_WB, p_W);
  return std::ranges::any_of(obstacle.body.shapes, [p_B](const world::Shape& shape) {
    // A ray that begins inside hits at once.
    return shape.kind == world::ShapeKind::kDisc
               ? world::cast_disc(p_B, {1, 0}, shape.centre, shape.radius_m) == 0
               : world::cast_polygon(p_B, {1, 0}, shape.vertices()) == 0;
  });
}

double top_of(const world::Body& body) {
  double top_m = 0;
  for (const world::Shape& shape : body.shapes) top_m = std::max(top_m, shape.z1_m);
  return top_m;
}

class Warnings {
 public:
  Warnings(const config::ExpandedScenario& scenario, const BuiltScenario& built)
      : scenario_(scenario), built_(built) {}

  std::vector<Error> all() && {
    targets();
    changes();
    rights();
    for (std::size_t g = 0; g < scenario_.groups.size(); ++g) robot(g);
    return std::move(warnings_);
  }

 private:
  template <class... Args>
  void warn(const SourceLocation& where, fmt::format_string<Args...> format, Args&&... args) {
    warnings_.push_back(
        {ErrorCode::kInvalidArgument, fmt::format(format, std::forward<Args>(args)...), where});
  }

  void targets() {
    for (const config::ArrivalCheckFile& check : scenario_.scenario.checks.arrivals) {
      for (const world::Obstacle& obstacle : built_.spec.world.obstacles) {
        if (!contains(obstacle, {check.x_m, check.y_m})) continue;
        warn(check.robot.where, "the target ({:g}, {:g}) of `{}` is inside the obstacle `{}`",
             check.x_m, check.y_m, *check.robot, obstacle.body.name);
        break;
      }
      const auto before_s = check.before_s;
      if (before_s && *before_s > scenario_.scenario.duration_s) {
        warn(check.robot.where, "`before_s`: {:g} s is after the end of the run ({:g} s)",
             *before_s, scenario_.scenario.duration_s.seconds);
      }
    }
  }

  void changes() {
    const double end_s = scenario_.scenario.duration_s;
    for (const config::ChangeFile& change : scenario_.scenario.changes) {
      if (!change.at_s || **change.at_s < end_s) continue;
      warn(change.at_s->where, "the change at {:g} s never happens: the run ends at {:g} s",
           **change.at_s, end_s);
    }
  }

  void rights() {
    std::set<std::string_view> teams;
    for (const config::RobotGroup& group : scenario_.groups) {
      if (!group.team.empty()) teams.insert(group.team);
    }
    const std::vector<std::string_view> names(teams.begin(), teams.end());
    for (const config::GuiRightFile& right : scenario_.scenario.gui.rights) {
      for (const auto& team : right.teams) {
        if (teams.contains(*team)) continue;
        warn(team.where, "no robot is of the team `{}`{}", *team,
             names.empty() ? "; no robot has a team" : suggestion(*team, names));
      }
    }
  }

  /// The first robot of a group.
  [[nodiscard]] std::size_t first_of(std::size_t group) const {
    const auto& robots = scenario_.robots;
    return static_cast<std::size_t>(
        std::ranges::find(robots, group, &config::ExpandedRobot::group) - robots.begin());
  }

  void robot(std::size_t group) {
    const std::size_t first = first_of(group);
    if (first == scenario_.robots.size()) return;
    const config::RobotGroup& file = scenario_.groups[group];
    const world::Body& body = built_.spec.world.robots[first];
    if (body.radius_m() > kHuge_m) {
      warn(file.robot.body.where,
           "the body of `{}` reaches {:g} m from its origin: lengths are in "
           "metres",
           *file.name, body.radius_m());
    }
    if (!file.robot.program && !file.robot.controllers.empty()) {
      warn(file.name.where,
           "robot `{}` has controllers but no `program`: it stands until a person drives it",
           *file.name);
    }
    heights(group, first);
  }

  /// A sensor that looks over all other bodies has no reading but the largest.
  void heights(std::size_t group, std::size_t first) {
    const auto& sensors = scenario_.groups[group].robot.sensors;
    const sim::RobotType& type = built_.spec.types[built_.spec.robots[first].type];
    const double top_m = top_beside(first);
    if (top_m <= 0) return;
    for (std::size_t s = 0; s < std::min(sensors.size(), type.sensors.size()); ++s) {
      if (type.sensors[s].kind != ReadingKind::kRanges || !type.simulated) continue;
      const double z_m = sensors[s].mount->z_m;
      if (z_m <= top_m) continue;
      warn(sensors[s].name.where,
           "sensor `{}` at {:g} m is above everything: the highest other body ends at {:g} m",
           *sensors[s].name, z_m, top_m);
    }
  }

  /// The top of the highest body but one robot; 0 without any.
  [[nodiscard]] double top_beside(std::size_t robot) const {
    double top_m = 0;
    for (const world::Obstacle& obstacle : built_.spec.world.obstacles) {
      top_m = std::max(top_m, top_of(obstacle.body));
    }
    const auto& robots = built_.spec.world.robots;
    for (std::size_t r = 0; r < robots.size(); ++r) {
      if (r != robot) top_m = std::max(top_m, top_of(robots[r]));
    }
    return top_m;
  }

  const config::ExpandedScenario& scenario_;
  const BuiltScenario& built_;
  std::vector<Error> warnings_;
};

}  // namespace

std::vector<Error> warnings_of(const config::ExpandedScenario& scenario,
                               const BuiltScenario& built) {
  return Warnings(scenario, built).all();
}

}  // namespace rave::runtime
