// SPDX-License-Identifier: Apache-2.0
// What is kept from step to step shows what a fresh look at the world shows.
#include "../src/near_lists.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "../src/listed_fan.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/each_target.hpp"

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

world::Body long_body(double length_m) {
  const double half_m = length_m / 2;
  const std::array<Vec2, 4> outline = {
      {{-half_m, -0.2}, {half_m, -0.2}, {half_m, 0.2}, {-half_m, 0.2}}};
  return body_of(outline, Layer::kSimulatedRobots);
}

/// Boxes and long walls that stand, some side by side; robots of one disc, of a disc off the
/// middle, square ones, and one so long that the index cuts it into pieces.
world::WorldModel crowded(RandomStream& random) {
  world::WorldModel model;
  for (int i = 0; i < 20; ++i) {
    const double half_m = random.uniform(0.1, 0.5);
    const double length_m = i % 5 == 0 ? random.uniform(2, 8) : half_m;
    const std::array<Vec2, 4> box = {
        {{-length_m, -half_m}, {length_m, -half_m}, {length_m, half_m}, {-length_m, half_m}}};
    const Pose2 X_WB{random.uniform(0, kSide_m), random.uniform(0, kSide_m), random.uniform(-3, 3)};
    model.obstacles.push_back({body_of(box, Layer::kVirtualObstacles), X_WB});
    // A second one with the same face: which of them is seen must always be the same.
    if (i % 5 == 0) model.obstacles.push_back({body_of(box, Layer::kMappedReal), X_WB});
  }
  const std::array<Vec2, 4> square = {{{-0.2, -0.2}, {0.2, -0.2}, {0.2, 0.2}, {-0.2, 0.2}}};
  for (int i = 0; i < 30; ++i) {
    model.robots.push_back(i % 3 == 0   ? round_body(0.15)
                           : i % 3 == 1 ? round_body(0.1, {0.3, 0})
                                        : body_of(square, Layer::kSimulatedRobots));
  }
  model.robots[5] = long_body(2.4);
  return model;
}

FanTable fan_of(std::uint32_t rays, double width_rad, double range_m, std::uint32_t cone = 1) {
  std::vector<double> bearings_rad(rays);
  for (std::uint32_t i = 0; i < rays; ++i) {
    bearings_rad[i] = width_rad * (i / static_cast<double>(rays) - 0.5);
  }
  FanQuery query;
  query.ray_count = rays;
  query.bearings_rad = bearings_rad.data();
  query.range_max_m = range_m;
  query.rays_per_reading = cone;
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

struct Uses {
  int made = 0;
  int used = 0;
};

/// Compares what is seen through lists with what the grids show, in so many random worlds.
void compare(const FanTable& fan, std::uint32_t worlds, Uses& uses) {
  for (std::uint32_t w = 0; w < worlds; ++w) {
    RandomStream random(31, w, fan.rays, 0);
    world::WorldModel model = crowded(random);
    world::Snapshot world(model);
    std::vector<Pose2> poses(model.robots.size());
    std::vector<RobotId> owners;
    for (std::uint32_t r = 0; r < poses.size(); ++r) {
      poses[r] = {random.uniform(0, kSide_m), random.uniform(0, kSide_m), random.uniform(-3, 3)};
      owners.emplace_back(r);
    }
    FanScratch scratch;
    FanScratch listed_scratch;
    BlockScratch block;
    NearLists lists;
    for (int step = 0; step < 120; ++step) {
      if (step == 60) {
        model.robots[0] = round_body(0.45);
        model.robots[5] = long_body(5);  // in more pieces than before
        world.body_changed(RobotId(0));
        world.body_changed(RobotId(5));
      }
      move_robots(world, random, poses);
      std::vector<SensorPlace> places;
      std::vector<Vec2> places_W;
      for (const Pose2& pose : poses) {
        places.push_back(sensor_place(pose, {0.1, 0.05, 0.4}));
        places_W.push_back(places.back().p_WS);
      }
      ++uses.used;
      if (!lists.hold(world, places_W)) {
        list_near(world, fan, 0.2, owners, places_W, 0.4, scratch, lists);
        ++uses.made;
      }
      ListedFans fans(world, fan, lists, places, listed_scratch, block);
      for (std::uint32_t r = 0; r < poses.size(); ++r) {
        std::vector<float> listed(fan.readings());
        std::vector<float> fresh(fan.readings());
        std::vector<std::uint32_t> listed_bodies(fan.readings());
        std::vector<std::uint32_t> fresh_bodies(fan.readings());
        fans.read(r, listed, listed_bodies);
        cast_fan(world, fan, places[r], 0.2, world.body_of(owners[r]), scratch, fresh,
                 fresh_bodies);
        ASSERT_EQ(listed_bodies, fresh_bodies) << "world " << w << ", step " << step;
        ASSERT_EQ(listed, fresh) << "world " << w << ", step " << step << ", robot " << r;
      }
    }
  }
}

/// Rays, width in rad, range in metres, rays of one reading.
class ListedFan
    : public ::testing::TestWithParam<std::tuple<std::uint32_t, double, double, std::uint32_t>> {};

TEST_P(ListedFan, SeesWhatTheGridsShow) {
  const auto [rays, width_rad, range_m, cone] = GetParam();
  Uses uses;
  ASSERT_NO_FATAL_FAILURE(compare(fan_of(rays, width_rad, range_m, cone), 6, uses));
  EXPECT_GT(uses.made, 6 * 6);
  EXPECT_LT(2 * uses.made, uses.used) << "kept lists are of use";
}

TEST(ListedFans, SeeItWithAllInstructions) {
  Uses uses;
  const int targets = for_each_target([&](const char* name) {
    SCOPED_TRACE(name);
    compare(fan_of(16, 2 * kPi, 3), 1, uses);
    compare(fan_of(32, 2 * kPi, 3, 2), 1, uses);
  });
  EXPECT_GE(targets, 2) << "a processor with one set of instructions shows nothing";
}

INSTANTIATE_TEST_SUITE_P(
    Fans, ListedFan,
    ::testing::Values(std::tuple{16U, 2 * kPi, 3.0, 1U}, std::tuple{24U, 2.0, 3.0, 1U},
                      std::tuple{24U, 2.0, 3.0, 3U}, std::tuple{32U, 2 * kPi, 3.0, 2U},
                      std::tuple{90U, kPi, 6.0, 1U}, std::tuple{100U, 4.0, 5.0, 1U}));

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

TEST(NearLists, DoNotHoldForWhatIsNoNumber) {
  world::WorldModel model;
  model.robots = {round_body(0.1)};
  world::Snapshot world(model);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto put = [&](double x) {
    world.set_robot(RobotId(0), {{x, 0, 0}, {}, true});
    world.rebuild();
  };
  put(nan);
  const std::array<Vec2, 1> nowhere = {{{nan, 0}}};
  const std::array<Vec2, 1> at = {{{0, 0}}};
  NearLists lists;
  lists.begin(world, at, 0.5);
  EXPECT_TRUE(lists.hold(world, at));
  EXPECT_FALSE(lists.hold(world, nowhere));
  put(0);
  EXPECT_FALSE(lists.hold(world, at)) << "it came from nowhere";
}

TEST(MotionWatch, TellsWhatMovedAndWhoJumped) {
  world::WorldModel model;
  model.robots = {round_body(0.1)};
  world::Snapshot world(model);
  const auto put = [&](double x) {
    world.set_robot(RobotId(0), {{x, 0, 0}, {}, true});
    world.rebuild();
  };
  MotionWatch watch;
  put(0);
  EXPECT_TRUE(std::isinf(watch.look(world)));
  EXPECT_EQ(watch.look(world), 0);
  put(0.25);
  put(0);
  EXPECT_EQ(watch.look(world), 0.5);
  put(3);
  EXPECT_TRUE(std::isinf(watch.look(world)));
}

TEST(NearLists, PayOnlyWhereTheyServeSeveralSteps) {
  EXPECT_EQ(NearLists::margin_for(1, 0.5), 0);
  EXPECT_EQ(NearLists::margin_for(std::numeric_limits<double>::infinity(), 0.5), 0);
  EXPECT_EQ(NearLists::margin_for(0.1, 0.5), 0.5);
  EXPECT_GT(NearLists::margin_for(0, 0.5), 0);
  EXPECT_LT(NearLists::margin_for(0.001, 0.5), 0.5);
}

}  // namespace
}  // namespace rave::sim::testing
