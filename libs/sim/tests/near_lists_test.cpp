// SPDX-License-Identifier: Apache-2.0
// What is kept from step to step shows what a fresh look at the world shows.
#include "../src/near_lists.hpp"

#include <gtest/gtest.h>

#include <array>

#include "../src/listed_fan.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kSide_m = 14;

world::Body body_of(std::span<const Vec2> outline, Layer layer) {
  world::Body body;
  body.shapes = world::make_prisms(outline, 0, 1).value();
  body.layer = layer;
  return body;
}

world::Body round_body(double radius_m, Vec2 centre = {}) {
  world::Body body;
  body.shapes.push_back(world::make_disc(centre, radius_m, 0, 0.4).value());
  body.layer = Layer::kSimulatedRobots;
  return body;
}

/// Boxes and long walls that stand; robots of one disc, of a disc off the middle, and square ones.
world::WorldModel crowded(RandomStream& random) {
  world::WorldModel model;
  for (int i = 0; i < 20; ++i) {
    const double half_m = random.uniform(0.1, 0.5);
    const double length_m = i % 5 == 0 ? random.uniform(2, 8) : half_m;
    const std::array<Vec2, 4> box = {
        {{-length_m, -half_m}, {length_m, -half_m}, {length_m, half_m}, {-length_m, half_m}}};
    model.obstacles.push_back(
        {body_of(box, Layer::kVirtualObstacles),
         {random.uniform(0, kSide_m), random.uniform(0, kSide_m), random.uniform(-3, 3)}});
  }
  const std::array<Vec2, 4> square = {{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}};
  for (int i = 0; i < 30; ++i) {
    model.robots.push_back(i % 3 == 0   ? round_body(0.15)
                           : i % 3 == 1 ? round_body(0.1, {0.3, 0})
                                        : body_of(square, Layer::kSimulatedRobots));
  }
  return model;
}

FanTable fan_of(std::uint32_t rays, double width_rad, double range_m) {
  std::vector<double> bearings_rad(rays);
  for (std::uint32_t i = 0; i < rays; ++i) {
    bearings_rad[i] = width_rad * (i / static_cast<double>(rays) - 0.5);
  }
  FanQuery query;
  query.ray_count = rays;
  query.bearings_rad = bearings_rad.data();
  query.range_max_m = range_m;
  return FanTable::make(query, kAllLayers);
}

/// Each robot a step ahead; now and then one jumps, vanishes or comes back.
void move_robots(world::Snapshot& world, RandomStream& random, std::vector<Pose2>& poses) {
  for (std::uint32_t r = 0; r < poses.size(); ++r) {
    Pose2& X_WR = poses[r];
    X_WR.yaw = wrap_angle(X_WR.yaw + random.uniform(-0.1, 0.1));
    X_WR = {X_WR.x + 0.03 * std::cos(X_WR.yaw), X_WR.y + 0.03 * std::sin(X_WR.yaw), X_WR.yaw};
    bool present = world.robot(RobotId(r)).present || world.drift_m() == 0;
    const std::uint32_t chance = random.bits() % 3000;
    if (chance == 0) X_WR = {random.uniform(0, kSide_m), random.uniform(0, kSide_m), 0};
    if (chance == 1) present = !present;
    world.set_robot(RobotId(r), {X_WR, {}, present});
  }
  world.rebuild();
}

class ListedFan : public ::testing::TestWithParam<std::tuple<std::uint32_t, double, double>> {};

TEST_P(ListedFan, SeesWhatTheGridsShow) {
  const auto [rays, width_rad, range_m] = GetParam();
  int made = 0;
  int used = 0;
  for (std::uint32_t w = 0; w < 6; ++w) {
    RandomStream random(31, w, rays, 0);
    world::WorldModel model = crowded(random);
    world::Snapshot world(model);
    std::vector<Pose2> poses(model.robots.size());
    std::vector<RobotId> owners;
    for (std::uint32_t r = 0; r < poses.size(); ++r) {
      poses[r] = {random.uniform(0, kSide_m), random.uniform(0, kSide_m), random.uniform(-3, 3)};
      owners.emplace_back(r);
    }
    const FanTable fan = fan_of(rays, width_rad, range_m);
    FanScratch scratch;
    NearLists lists;
    for (int step = 0; step < 120; ++step) {
      if (step == 60) {
        model.robots[0] = round_body(0.45);
        world.body_changed(RobotId(0));
      }
      move_robots(world, random, poses);
      std::vector<Vec2> places_W;
      for (const Pose2& pose : poses) places_W.push_back(pose.position());
      ++used;
      if (!lists.hold(world, places_W)) {
        list_near(world, fan, 0.2, owners, places_W, 0.4, scratch, lists);
        ++made;
      }
      for (std::uint32_t r = 0; r < poses.size(); ++r) {
        std::vector<float> listed(rays);
        std::vector<float> fresh(rays);
        std::vector<std::uint32_t> bodies(rays);
        const SensorPlace place = sensor_place(poses[r], Pose2{});
        cast_fan(world, fan, place, lists, r, scratch, listed, bodies);
        cast_fan(world, fan, place, 0.2, world.body_of(owners[r]), scratch, fresh, bodies);
        ASSERT_EQ(listed, fresh) << "world " << w << ", step " << step << ", robot " << r;
      }
    }
  }
  EXPECT_GT(made, 6 * 6);
  EXPECT_LT(2 * made, used) << "kept lists are of use";
}

INSTANTIATE_TEST_SUITE_P(Fans, ListedFan,
                         ::testing::Values(std::tuple{16U, 2 * kPi, 3.0}, std::tuple{24U, 2.0, 3.0},
                                           std::tuple{90U, kPi, 6.0}, std::tuple{100U, 4.0, 5.0}));

TEST(NearLists, HoldUntilThingsHaveMovedByTheMargin) {
  world::WorldModel model;
  model.robots = {round_body(0.1), round_body(0.1)};
  world::Snapshot world(model);
  const auto put = [&](double x) {
    world.set_robot(RobotId(0), {{x, 0, 0}, {}, true});
    world.set_robot(RobotId(1), {{5, 5, 0}, {}, true});
    world.rebuild();
  };
  put(0);
  const std::array<Vec2, 2> at = {{{0, 0}, {5, 5}}};
  NearLists lists;
  EXPECT_FALSE(lists.hold(world, at));
  lists.begin(world, at, 0.5);
  EXPECT_TRUE(lists.hold(world, at));
  EXPECT_TRUE(lists.hold(world, at, 0.49));
  EXPECT_FALSE(lists.hold(world, at, 0.51));
  put(0.3);  // another robot has come nearer by as much
  EXPECT_TRUE(lists.hold(world, at));
  const std::array<Vec2, 2> moved = {{{0.3, 0}, {5, 5}}};
  EXPECT_FALSE(lists.hold(world, moved));  // and the asker itself
  EXPECT_FALSE(lists.hold(world, std::span(at).first(1)));
  lists.begin(world, moved, 0.5);
  EXPECT_TRUE(lists.hold(world, moved));
  put(3);  // a jump
  EXPECT_FALSE(lists.hold(world, moved));
}

TEST(NearLists, PayOnlyWhereTheyServeSeveralSteps) {
  EXPECT_EQ(NearLists::margin_for(1, 0.5), 0);
  EXPECT_EQ(NearLists::margin_for(0.1, 0.5), 0.5);
  EXPECT_GT(NearLists::margin_for(0, 0.5), 0);
  EXPECT_LT(NearLists::margin_for(0.001, 0.5), 0.5);
}

}  // namespace
}  // namespace rave::sim::testing
