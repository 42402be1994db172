// SPDX-License-Identifier: Apache-2.0
#include "places.hpp"

#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/shape_grid.hpp"
#include "rave/world/touching.hpp"

namespace rave::runtime {
namespace {

/// The device number for drawing places.
/// Random streams are keyed by seed, robot and device. This number is far from those of sensors and
/// below those of programs (0xffff0000), so places share a stream with neither.
constexpr std::uint32_t kPlaceDevice = 0xfffe'0000U;
constexpr std::uint32_t kMaxTries = 10'000;

/// The robots already placed: a spatial hash of square cells as wide as the largest pair of robots.
class Standing {
 public:
  Standing(const sim::EngineSpec& spec) : spec_(&spec) {
    // The lower bound is for very small robots: a clearance must not reach over thousands of cells.
    double widest_m = 0.05;
    for (const world::Body& body : spec.world.robots) {
      radius_m_.push_back(body.radius_m());
      widest_m = std::max(widest_m, radius_m_.back());
    }
    widest_m_ = widest_m;
    std::vector<world::ShapePiece> pieces;
    for (std::uint32_t i = 0; i < spec.world.obstacles.size(); ++i) {
      const world::Obstacle& obstacle = spec.world.obstacles[i];
      for (const world::Shape& shape : obstacle.body.shapes) {
        for (const world::CoverDisc& disc : world::cover(shape, 1.0)) {
          world::ShapePiece piece;
          piece.centre_W = transform(obstacle.X_WB, disc.centre_B);
          // The next float may be smaller than the double, so the disc grows by more than one unit
          // in the last place (relative 6e-8). The grid may return too much, never too little.
          piece.radius_m = static_cast<float>(disc.radius_m * (1 + 1e-6));
          piece.body = i;
          pieces.push_back(piece);
        }
      }
    }
    // Cells as wide as the covering discs, so a query visits few cells and a disc is in few.
    obstacles_.build(pieces, 2.0);
  }

  void add(std::uint32_t robot) {
    cells_[key(spec_->robots[robot].X_WR.position())].push_back(robot);
  }

  /// A body that is nearer than `clearance_m` to robot `id` at `X_WR`, and the depth.
  struct Conflict {
    std::string name;
    double separation_m = 0;
  };
  [[nodiscard]] std::optional<Conflict> conflict(std::uint32_t id, const Pose2& X_WR,
                                                 double clearance_m) const {
    const world::Body& body = spec_->world.robots[id];
    std::vector<std::uint32_t> near;
    obstacles_.for_each_near(X_WR.position(), radius_m_[id] + clearance_m,
                             [&](const world::ShapePiece& piece) { near.push_back(piece.body); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t i : near) {
      const world::Obstacle& obstacle = spec_->world.obstacles[i];
      // The grid gives candidates; the exact distance of the outlines decides. It is negative if
      // they overlap.
      const double gap = world::separation(body, X_WR, obstacle.body, obstacle.X_WB).distance_m;
      if (gap < clearance_m) return Conflict{obstacle.body.name, gap};
    }
    const double reach_m = radius_m_[id] + widest_m_ + clearance_m;
    // With a large clearance the reach is longer than a cell, so this is a square of several cells,
    // not always three by three.
    const auto cells = static_cast<std::int64_t>(std::ceil(reach_m / cell_m()));
    const auto [cx, cy] = cell(X_WR.position());
    for (std::int64_t y = cy - cells; y <= cy + cells; ++y) {
      for (std::int64_t x = cx - cells; x <= cx + cells; ++x) {
        const auto found = cells_.find(key(x, y));
        if (found == cells_.end()) continue;
        for (const std::uint32_t other : found->second) {
          const double gap =
              world::separation(body, X_WR, spec_->world.robots[other], spec_->robots[other].X_WR)
                  .distance_m;
          if (gap < clearance_m) return Conflict{spec_->robots[other].name, gap};
        }
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] double cell_m() const noexcept { return 2 * widest_m_; }
  [[nodiscard]] std::pair<std::int64_t, std::int64_t> cell(Vec2 p) const noexcept {
    return {static_cast<std::int64_t>(std::floor(p.x / cell_m())),
            static_cast<std::int64_t>(std::floor(p.y / cell_m()))};
  }
  [[nodiscard]] static std::uint64_t key(std::int64_t x, std::int64_t y) noexcept {
    return (static_cast<std::uint64_t>(x) << 32) ^ (static_cast<std::uint64_t>(y) & 0xffff'ffffU);
  }
  [[nodiscard]] std::uint64_t key(Vec2 p) const noexcept {
    const auto [x, y] = cell(p);
    return key(x, y);
  }

  const sim::EngineSpec* spec_;
  std::vector<double> radius_m_;
  double widest_m_ = 0;
  world::ShapeGrid obstacles_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

Status scatter(const config::RobotGroup& group, std::uint32_t robot, const Standing& standing,
               sim::EngineSpec& spec) {
  const config::ScatterFile& area = *group.scatter;
  for (std::uint32_t attempt = 0; attempt < kMaxTries; ++attempt) {
    // One stream per attempt: the place of a robot depends on the seed, its id and the robots
    // before it, not on the number of draws that others needed.
    RandomStream random(spec.seed, robot, kPlaceDevice, attempt);
    const double x = random.uniform(area.x_m[0], area.x_m[1]);
    const double y = random.uniform(area.y_m[0], area.y_m[1]);
    const Pose2 X_WR{x, y, random.uniform(-kPi, kPi)};
    if (standing.conflict(robot, X_WR, area.clearance_m)) continue;
    spec.robots[robot].X_WR = X_WR;
    return {};
  }
  return fail_at(group.name.where, ErrorCode::kInvalidArgument,
                 "no free place for robot `{}` after {} tries: `scatter` asks for too many robots, "
                 "or for more clearance than x_m {} to {} and y_m {} to {} leave",
                 spec.robots[robot].name, kMaxTries, area.x_m[0], area.x_m[1], area.y_m[0],
                 area.y_m[1]);
}

}  // namespace

Status put_down_robots(const config::ExpandedScenario& scenario, sim::EngineSpec& spec) {
  Standing standing(spec);
  // Given poses first, so that scattered robots avoid all of them.
  for (const bool scattered : {false, true}) {
    for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
      const config::RobotGroup& group = scenario.group_of(scenario.robots[r]);
      if (group.scatter.has_value() != scattered) continue;
      const bool simulated = spec.types[spec.robots[r].type].simulated;
      const auto& pose = scenario.robots[r].pose;
      // A real robot may have no stated start. It is absent until its pose source reports it.
      if (scattered) {
        RAVE_TRY(scatter(group, r, standing, spec));
      } else if (pose) {
        spec.robots[r].X_WR = {pose->x_m, pose->y_m, wrap_angle(deg_to_rad(pose->yaw_deg))};
      } else if (simulated) {
        return fail_at(
            group.name.where, ErrorCode::kInvalidArgument,
            "robot `{}` is simulated and has no start pose: expected `pose`, `poses` or `scatter`",
            spec.robots[r].name);
      }
      // The stated start of a real robot is kept free; its pose source reports its actual pose.
      if (!simulated && pose) standing.add(r);
      if (!simulated) continue;
      // Also for scattered robots, for which it holds by construction; the check is cheap.
      const auto conflict = standing.conflict(r, spec.robots[r].X_WR, 0);
      if (conflict) {
        return fail_at(group.name.where, ErrorCode::kInvalidArgument,
                       "robot `{}` starts inside `{}` ({:.3f} m deep); expected a free place",
                       spec.robots[r].name, conflict->name, -conflict->separation_m);
      }
      standing.add(r);
    }
  }
  return {};
}

}  // namespace rave::runtime
