// SPDX-License-Identifier: Apache-2.0
// Robots that people put elsewhere.
#include <cmath>

#include "rave/math/transform.hpp"
#include "rave/world/touching.hpp"
#include "world_truth.hpp"

namespace rave::sim {

Status WorldTruth::check_place(RobotId robot, const Pose2& X_WR) const {
  const std::uint32_t r = robot.value();
  if (!movers[r].simulated) {
    return fail(ErrorCode::kInvalidArgument, "a real robot cannot be placed; move it by hand");
  }
  const auto own = static_cast<std::uint32_t>(spec.world.obstacles.size()) + r;
  const world::Body& body = spec.world.robots[r];
  for (std::uint32_t other = 0; other < spec.world.body_count(); ++other) {
    const std::uint32_t other_robot = other - (own - r);
    const world::Obstacle* const obstacle = spec.world.obstacle(other);
    const bool is_robot = obstacle == nullptr;
    if (other == own || (is_robot ? !movers[other_robot].present : obstacle->removed)) continue;
    const Pose2 X_WB = is_robot ? movers[other_robot].X_WR : obstacle->X_WB;
    const world::Body& theirs = spec.world.body(other);
    // A cheap test first: the separation of two outlines is costly, and a world may have thousands.
    const double reach_m = body.radius_m() + theirs.radius_m() + kApart_m;
    if (squared_norm(X_WB.position() - X_WR.position()) > reach_m * reach_m) continue;
    if (world::separation(body, X_WR, theirs, X_WB).distance_m >= kApart_m) continue;
    return fail(ErrorCode::kInvalidArgument, "at ({:.2f}, {:.2f}) it would overlap `{}`", X_WR.x,
                X_WR.y,
                theirs.name.empty() && is_robot ? spec.robots[other_robot].name : theirs.name);
  }
  return {};
}

Status WorldTruth::place(RobotId robot, const Pose2& X_WR) {
  const std::uint32_t r = robot.value();
  RAVE_TRY(check_place(robot, X_WR));
  // What was near it says nothing of where it is now.
  slack_m_ += std::sqrt(squared_norm(X_WR.position() - movers[r].X_WR.position()));
  movers[r].X_WR = X_WR;
  velocity[r] = {};
  proposal[r] = {};
  limited[r] = 0;
  touch[r] = {};
  return {};
}

}  // namespace rave::sim
