// SPDX-License-Identifier: Apache-2.0
#include "rave/math/time_of_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_shapes.hpp"
#include "rave/math/separation.hpp"
#include "rave/math/transform.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave {
namespace {

constexpr double kSkin_m = 1e-4;

TEST(TimeOfImpact, FastBodyStopsAtAThinWall) {
  const ConvexPolygon robot = regular_polygon(8, 0.1);
  const ConvexPolygon wall = ConvexPolygon::box(0.05, 4).value();
  // 3 m/s for 0.1 s would carry it from 0.15 m before the wall to the far side.
  const Impact impact = time_of_impact(robot, {-0.175, 0.3, 0}, {0.3, 0, 0}, wall, {});
  EXPECT_TRUE(impact.hit);
  EXPECT_NEAR(impact.fraction, (0.05 - kSkin_m) / 0.3, 1e-5);
  EXPECT_EQ(impact.normal_W, (Vec2{1, 0}));
  EXPECT_GE(impact.distance_m, kSkin_m - 1e-11);
  EXPECT_LE(impact.distance_m, kSkin_m + 1e-6);
}

TEST(TimeOfImpact, LongBoxTurnsIntoAWall) {
  const ConvexPolygon rod = ConvexPolygon::box(2, 0.1).value();
  const ConvexPolygon wall = ConvexPolygon::box(4, 0.1).value();
  const Impact impact = time_of_impact(rod, {0, 0, 0}, {0, 0, kPi / 2}, wall, {0, 0.75, 0});
  EXPECT_TRUE(impact.hit);
  const Pose2 end = advance({}, {0, 0, kPi / 2}, impact.fraction);
  // The leading corner (1, 0.05) reaches the wall's face at 0.7.
  const double reach = hypot(1, 0.05);
  EXPECT_NEAR(end.yaw, asin((0.7 - kSkin_m) / reach) - atan2(0.05, 1), 1e-5);
  EXPECT_GE(impact.distance_m, kSkin_m - 1e-11);
  EXPECT_NEAR(impact.normal_W.y, 1, 1e-12);
  EXPECT_FALSE(time_of_impact(rod, {}, {0, 0, 2 * kPi}, wall, {0, 1.2, 0}).hit);
}

TEST(TimeOfImpact, SlidesAlongAWallAtAnyAngle) {
  const ConvexPolygon robot = ConvexPolygon::box(0.4, 0.3).value();
  const ConvexPolygon wall = ConvexPolygon::box(20, 0.1).value();
  RandomStream random(60, 0, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Pose2 X_WB = random_pose(random, 50);
    // At the skin, below it, and inside the wall.
    const double gap_m = kSkin_m * (1 - i % 3);
    const Pose2 X_WA = compose(X_WB, {random.uniform(-2, 2), -(0.2 + gap_m), 0});
    const Vec2 along = rotate(X_WB.yaw, {random.uniform(-1, 1), 0});
    const Impact impact = time_of_impact(robot, X_WA, {along.x, along.y, 0}, wall, X_WB);
    ASSERT_FALSE(impact.hit) << i;
    ASSERT_EQ(impact.fraction, 1);
  }
}

TEST(TimeOfImpact, InsideTheSkinOnlyTheWayOutIsFree) {
  const ConvexPolygon box = ConvexPolygon::box(1, 1).value();
  for (const double gap_m : {0.5 * kSkin_m, 0.0, -0.01}) {
    const Pose2 X_WA{-1 - gap_m, 0.2, 0};
    const Impact inwards = time_of_impact(box, X_WA, {0.1, 0.02, 0}, box, {});
    EXPECT_TRUE(inwards.hit);
    EXPECT_LT(inwards.fraction, 1e-9);
    EXPECT_EQ(inwards.normal_W, (Vec2{1, 0}));
    EXPECT_FALSE(time_of_impact(box, X_WA, {-0.1, 0.02, 0}, box, {}).hit);
    EXPECT_FALSE(time_of_impact(box, X_WA, {0, 0.1, 0}, box, {}).hit);
    // The flat side may not turn a corner into the other.
    EXPECT_LT(time_of_impact(box, X_WA, {0, 0, 0.1}, box, {}).fraction, 1e-3);
  }
}

TEST(TimeOfImpact, APointedBodyMayTurnOnItsTip) {
  const ConvexPolygon diamond = regular_polygon(4, 0.5);
  const ConvexPolygon wall = ConvexPolygon::box(1, 4).value();
  const Impact impact = time_of_impact(diamond, {-1 - kSkin_m, 0, 0}, {0, 0, 0.5}, wall, {});
  EXPECT_FALSE(impact.hit);
}

TEST(TimeOfImpact, NoMotionIsFree) {
  const ConvexPolygon box = ConvexPolygon::box(1, 1).value();
  EXPECT_FALSE(time_of_impact(box, {0.2, 0, 0}, {}, box, {}).hit);
}

TEST(TimeOfImpact, PressingAndTurningOnAWallDoesNotCreepIn) {
  const ConvexPolygon robot = regular_polygon(7, 0.2);
  const ConvexPolygon wall = ConvexPolygon::box(1, 40).value();
  Pose2 X_WA{-0.75, -10, 0.1};
  RandomStream random(61, 0, 0, 0);
  for (int i = 0; i < 20'000; ++i) {
    const double dx = random.uniform(0, 0.02);
    const double dy = random.uniform(-0.001, 0.002);
    const Motion2 motion{dx, dy, random.uniform(-0.05, 0.05)};
    X_WA = advance(X_WA, motion, time_of_impact(robot, X_WA, motion, wall, {}).fraction);
  }
  const double gap_m = distance(robot, X_WA, wall, {}).distance_m;
  EXPECT_GE(gap_m, kSkin_m - 1e-7);
  EXPECT_LE(gap_m, kSkin_m + 1e-2);
}

// Every stop is at the skin, nothing before it is nearer, and free motions are free throughout.
TEST(TimeOfImpact, AgreesWithSmallSteps) {
  RandomStream random(62, 0, 0, 0);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const ConvexPolygon a = random_convex(random, 0.5);
    const ConvexPolygon b = random_convex(random, random.uniform(0.05, 1));
    const Pose2 X_WA = random_pose(random, 2);
    const Pose2 X_WB = random_pose(random, 2);
    if (distance(a, X_WA, b, X_WB).distance_m < kSkin_m) continue;
    // Roughly towards b.
    const Pose2 d = random_pose(random, 1);
    const Motion2 motion{X_WB.x - X_WA.x + d.x, X_WB.y - X_WA.y + d.y,
                         i % 3 == 0 ? 0.0 : 2 * d.yaw};
    const Impact impact = time_of_impact(a, X_WA, motion, b, X_WB);
    hits += impact.hit ? 1 : 0;
    for (int k = 0; k <= 100; ++k) {
      const Pose2 pose = advance(X_WA, motion, 0.01 * k * impact.fraction);
      ASSERT_GE(distance(a, pose, b, X_WB).distance_m, kSkin_m - 2e-12) << i << " " << k;
    }
    if (!impact.hit) {
      ASSERT_EQ(impact.fraction, 1);
      continue;
    }
    ASSERT_LE(impact.distance_m, kSkin_m + 1.1e-6) << i;
    const Pose2 end = advance(X_WA, motion, impact.fraction);
    ASSERT_NEAR(distance(a, end, b, X_WB).distance_m, impact.distance_m, 1e-12);
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace rave
