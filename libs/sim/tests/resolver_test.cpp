// SPDX-License-Identifier: Apache-2.0
#include "../src/resolver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

constexpr double kSkin_m = 1e-4;

world::Body disc_robot(double radius_m) {
  world::Body body;
  body.shapes.push_back(world::make_disc({}, radius_m, 0, 1).value());
  body.layer = Layer::kSimulatedRobots;
  return body;
}

world::Body box_robot(double length_m, double width_m) {
  world::Body body;
  const double x = length_m / 2;
  const double y = width_m / 2;
  body.shapes =
      world::make_prisms(std::vector<Vec2>{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, 0, 1).value();
  body.layer = Layer::kSimulatedRobots;
  return body;
}

world::Obstacle wall(const Pose2& X_WB, double length_m, double width_m) {
  world::Obstacle obstacle;
  obstacle.body = box_robot(length_m, width_m);
  obstacle.body.layer = Layer::kVirtualObstacles;
  obstacle.X_WB = X_WB;
  return obstacle;
}

/// A world with its robots and the resolver that moves them.
struct Arena {
  world::WorldModel model;
  std::vector<Mover> movers;
  std::vector<ContactNote> notes;
  std::unique_ptr<world::Snapshot> snapshot;
  std::unique_ptr<Resolver> resolver;

  void begin() {
    snapshot = std::make_unique<world::Snapshot>(model);
    resolver = std::make_unique<Resolver>(model);
    refresh();
  }
  void refresh() {
    for (std::uint32_t r = 0; r < movers.size(); ++r) {
      snapshot->set_robot(RobotId(r), {movers[r].X_WR, {}, true});
    }
    snapshot->rebuild();
  }
  void step(const std::vector<Motion2>& motions, double slack_m) {
    notes.clear();
    for (std::uint32_t r = 0; r < movers.size(); ++r) {
      if (movers[r].simulated) resolver->move(r, motions[r], *snapshot, slack_m, movers, notes);
    }
    refresh();
  }
  /// The deepest overlap of any pair, as a negative separation.
  [[nodiscard]] double least_separation() const {
    double least = 1e9;
    for (std::size_t a = 0; a < movers.size(); ++a) {
      for (const world::Obstacle& obstacle : model.obstacles) {
        least = std::min(
            least, world::separation(model.robots[a], movers[a].X_WR, obstacle.body, obstacle.X_WB)
                       .distance_m);
      }
      for (std::size_t b = a + 1; b < movers.size(); ++b) {
        if (squared_norm(movers[a].X_WR.position() - movers[b].X_WR.position()) > 4) continue;
        least = std::min(least, world::separation(model.robots[a], movers[a].X_WR, model.robots[b],
                                                  movers[b].X_WR)
                                    .distance_m);
      }
    }
    return least;
  }
};

TEST(Resolver, AFastRobotStopsAtAThinWall) {
  for (const bool is_box : {false, true}) {
    Arena arena;
    arena.model.obstacles.push_back(wall({2, 0, 0}, 0.05, 4));
    arena.model.robots.push_back(is_box ? box_robot(0.4, 0.3) : disc_robot(0.15));
    arena.movers.push_back({{0, 0, 0.1}, true, true});
    arena.begin();
    for (int i = 0; i < 40; ++i) arena.step({{0.3, 0, 0}}, 0.3);  // 3 m/s, steps of 0.1 s
    EXPECT_LT(arena.movers[0].X_WR.x, 2.0) << "tunnelled, box " << is_box;
    EXPECT_GT(arena.movers[0].X_WR.x, 1.7);
    EXPECT_GE(arena.least_separation(), kSkin_m - 1e-9);
  }
}

TEST(Resolver, ARobotThatPressesOnAWallSlidesAlongIt) {
  Arena arena;
  arena.model.obstacles.push_back(wall({1, 0, 0}, 0.1, 20));
  arena.model.robots.push_back(disc_robot(0.15));
  arena.movers.push_back({{0.5, 0, 0}, true, true});
  arena.begin();
  for (int i = 0; i < 100; ++i) arena.step({{0.03, 0.03, 0}}, 0.05);
  EXPECT_NEAR(arena.movers[0].X_WR.y, 3.0, 0.01);
  EXPECT_NEAR(arena.movers[0].X_WR.x, 1 - 0.05 - 0.15, 1e-3);
}

TEST(Resolver, ABoxThatPressesOnAWallSlidesAlongIt) {
  Arena arena;
  arena.model.obstacles.push_back(wall({1, 0, 0}, 0.1, 20));
  arena.model.robots.push_back(box_robot(0.4, 0.2));
  arena.movers.push_back({{0.5, 0, 0}, true, true});
  arena.begin();
  for (int i = 0; i < 100; ++i) arena.step({{0.03, 0.03, 0.001}}, 0.05);
  EXPECT_GT(arena.movers[0].X_WR.y, 2.7);
  EXPECT_GE(arena.least_separation(), kSkin_m - 1e-9);
}

TEST(Resolver, ABlockedRobotMayTurnAwayAndLeave) {
  Arena arena;
  arena.model.obstacles.push_back(wall({1, 0, 0}, 0.1, 20));
  arena.model.robots.push_back(disc_robot(0.15));
  arena.movers.push_back({{0.5, 0, 0}, true, true});
  arena.begin();
  for (int i = 0; i < 30; ++i) arena.step({{0.03, 0, 0}}, 0.05);
  for (int i = 0; i < 30; ++i) arena.step({{-0.03, 0, 0.1}}, 0.05);
  EXPECT_NEAR(arena.movers[0].X_WR.x, 0.8 - kSkin_m - 0.9, 1e-3);
}

TEST(Resolver, ACrowdDrivenIntoACornerNeverOverlaps) {
  Arena arena;
  arena.model.obstacles.push_back(wall({5, 0, 0}, 0.05, 12));
  arena.model.obstacles.push_back(wall({0, 5, 0}, 12, 0.05));
  RandomStream random(3, 1, 4, 1);
  for (int i = 0; i < 150; ++i) {
    arena.model.robots.push_back(i % 3 == 0 ? box_robot(0.3, 0.2) : disc_robot(0.15));
    const int row = i / 15;
    arena.movers.push_back({{-4.0 + 0.6 * (i % 15), -4.0 + 0.6 * row, 0}, true, true});
  }
  arena.begin();
  ASSERT_GT(arena.least_separation(), 0);
  for (int i = 0; i < 300; ++i) {
    std::vector<Motion2> motions;
    for (std::size_t r = 0; r < arena.movers.size(); ++r) {
      motions.push_back(
          {random.uniform(0, 0.06), random.uniform(0, 0.06), random.uniform(-0.1, 0.1)});
    }
    arena.step(motions, 0.09);
    if (i % 20 == 0) {
      ASSERT_GE(arena.least_separation(), 0) << "step " << i;
    }
  }
  EXPECT_GE(arena.least_separation(), 0);
}

TEST(Resolver, SimulatedRobotsMakeWayForARealOne) {
  Arena arena;
  arena.model.robots = {disc_robot(0.2), disc_robot(0.2)};
  arena.movers = {{{0, 0, 0}, false, true}, {{0.35, 0.02, 0}, true, true}};
  arena.begin();
  arena.resolver->make_way(0, *arena.snapshot, 0, arena.movers, arena.notes);
  EXPECT_EQ(arena.movers[0].X_WR, (Pose2{0, 0, 0}));
  EXPECT_GE(arena.least_separation(), 0);
  ASSERT_EQ(arena.notes.size(), 1U);
  EXPECT_FALSE(arena.notes[0].pinned);
  EXPECT_LT(arena.notes[0].direction_W.x, -0.9) << "the real robot is behind";
}

TEST(Resolver, ARobotBetweenARealOneAndAWallIsPinned) {
  Arena arena;
  arena.model.obstacles.push_back(wall({0.5, 0, 0}, 0.1, 20));
  arena.model.robots = {disc_robot(0.2), disc_robot(0.2)};
  arena.movers = {{{0, 0, 0}, false, true}, {{0.2, 0, 0}, true, true}};
  arena.begin();
  arena.resolver->make_way(0, *arena.snapshot, 0, arena.movers, arena.notes);
  EXPECT_EQ(arena.movers[0].X_WR, (Pose2{0, 0, 0}));
  ASSERT_EQ(arena.notes.size(), 1U);
  EXPECT_TRUE(arena.notes[0].pinned);
  const double to_wall =
      world::separation(arena.model.robots[1], arena.movers[1].X_WR, arena.model.obstacles[0].body,
                        arena.model.obstacles[0].X_WB)
          .distance_m;
  EXPECT_GE(to_wall, 0) << "it was pushed into the wall";
}

TEST(Resolver, BodiesAtOtherHeightsDoNotMeet) {
  Arena arena;
  world::Obstacle bridge = wall({1, 0, 0}, 0.2, 4);
  for (world::Shape& shape : bridge.body.shapes) {
    shape.z0_m = 2;
    shape.z1_m = 3;
  }
  arena.model.obstacles.push_back(bridge);
  arena.model.robots.push_back(disc_robot(0.2));
  arena.movers.push_back({{0, 0, 0}, true, true});
  arena.begin();
  for (int i = 0; i < 20; ++i) arena.step({{0.1, 0, 0}}, 0.1);
  EXPECT_NEAR(arena.movers[0].X_WR.x, 2.0, 1e-9);
}

TEST(Resolver, WhoWasPushedByOneRealRobotIsFoundByTheNext) {
  Arena arena;
  // The first real robot throws the simulated one half a metre ahead, on to the second.
  for (int i = 0; i < 2; ++i) arena.model.robots.push_back(disc_robot(0.4));
  arena.model.robots.push_back(disc_robot(0.1));
  arena.movers = {
      {{0, 0, 0}, false, true}, {{0.78, 0.3, 0}, false, true}, {{0.05, 0, 0}, true, true}};
  arena.begin();
  double slack_m = 0;
  for (const std::uint32_t real : {0U, 1U}) {
    slack_m += arena.resolver->make_way(real, *arena.snapshot, slack_m, arena.movers, arena.notes);
  }
  EXPECT_GT(slack_m, 0.4);
  EXPECT_GE(world::separation(arena.model.robots[2], arena.movers[2].X_WR, arena.model.robots[1],
                              arena.movers[1].X_WR)
                .distance_m,
            0);
}

}  // namespace
}  // namespace rave::sim
