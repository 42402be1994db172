// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "../src/motion_phase.hpp"
#include "rave/base/random.hpp"
#include "rave/math/transform.hpp"

/// Worlds for tests of what the resolve phase does with the motion of robots.
namespace rave::sim::testing {

inline world::Body solid(std::vector<world::Shape> shapes, Layer layer = Layer::kSimulatedRobots) {
  world::Body body;
  body.shapes = std::move(shapes);
  body.layer = layer;
  return body;
}

inline world::Body round_robot(double radius_m, Vec2 centre = {}) {
  return solid({world::make_disc(centre, radius_m, 0, 1).value()});
}

inline world::Body square_robot(double length_m, double width_m) {
  const double x = length_m / 2;
  const double y = width_m / 2;
  return solid(
      world::make_prisms(std::vector<Vec2>{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0, 1).value());
}

inline world::Obstacle standing(world::Body body, const Pose2& X_WB) {
  body.layer = Layer::kVirtualObstacles;
  return {std::move(body), X_WB};
}

/// Robots, what they are told to do, and the phase that moves them.
struct ContactArena {
  explicit ContactArena(unsigned threads = 1) : pool(threads) {}

  world::WorldModel model;
  std::vector<Mover> movers;
  std::vector<Twist2> proposal;  ///< Body frame.
  std::vector<Twist2> velocity;
  std::vector<std::uint8_t> limited;
  std::vector<TouchState> touch;
  std::vector<ContactNote> notes;
  ThreadPool pool;
  std::unique_ptr<world::Snapshot> snapshot;
  std::unique_ptr<Resolver> resolver;
  std::unique_ptr<MotionPhase> phase;

  std::uint32_t add(world::Body body, const Pose2& X_WR, bool simulated = true) {
    model.robots.push_back(std::move(body));
    movers.push_back({X_WR, simulated, true});
    return static_cast<std::uint32_t>(movers.size()) - 1;
  }
  /// When all bodies are there.
  void begin() {
    proposal.resize(movers.size());
    velocity.resize(movers.size());
    limited.resize(movers.size());
    touch.resize(movers.size());
    snapshot = std::make_unique<world::Snapshot>(model);
    resolver = std::make_unique<Resolver>(model);
    phase = std::make_unique<MotionPhase>(*resolver, pool);
    refresh();
  }
  void refresh() {
    for (std::uint32_t r = 0; r < movers.size(); ++r) {
      snapshot->set_robot(RobotId(r), {movers[r].X_WR, {}, movers[r].present});
    }
    snapshot->rebuild();
  }
  /// Robot `r` shall go with a velocity that is given in the world's axes.
  void drive(std::uint32_t r, Vec2 v_W_mps, double turn_radps = 0) {
    const Vec2 v = rotate_back(sincos(movers[r].X_WR.yaw), v_W_mps);
    proposal[r] = {v.x, v.y, turn_radps};
  }
  void step(double dt_s) {
    phase->run(*snapshot, dt_s, {movers, proposal, velocity, limited, touch}, notes);
    refresh();
  }
  [[nodiscard]] double gap(std::uint32_t a, std::uint32_t b) const {
    return world::separation(model.robots[a], movers[a].X_WR, model.robots[b], movers[b].X_WR)
        .distance_m;
  }
  [[nodiscard]] double gap_to(const world::Obstacle& obstacle, std::uint32_t r) const {
    return world::separation(model.robots[r], movers[r].X_WR, obstacle.body, obstacle.X_WB)
        .distance_m;
  }

  /// The least separation of any two, below 0 if they overlap; pairs whose discs about the origins
  /// do not meet are passed over.
  [[nodiscard]] double least_gap() const {
    const auto obstacles = static_cast<std::uint32_t>(model.obstacles.size());
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t a = 0; a < movers.size(); ++a) {
      const Vec2 p = movers[a].X_WR.position();
      const double radius_m = resolver->radius_m(a);
      snapshot->for_each_near(p, radius_m, [&](const world::ShapePiece& piece) {
        if (piece.body < obstacles) {
          least = std::min(least, gap_to(model.obstacles[piece.body], a));
          return;
        }
        const std::uint32_t b = piece.body - obstacles;
        if (b <= a) return;
        const double meet_m = radius_m + resolver->radius_m(b);
        if (squared_norm(movers[b].X_WR.position() - p) > meet_m * meet_m) return;
        least = std::min(least, gap(a, b));
      });
    }
    return least;
  }
};

}  // namespace rave::sim::testing
