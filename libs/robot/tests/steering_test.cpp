// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/steering.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rave/math/scalar.hpp"

namespace rave {
namespace {

const Steering kSteering(0.3, 1.0);

TEST(Steering, ADiscTouchesAPointWhereGeometrySays) {
  const std::vector<Vec2> points{{0.8, 0.1}};
  EXPECT_NEAR(kSteering.free_m(points, 0, 5), 0.8 - std::sqrt(0.09 - 0.01), 1e-12);
  EXPECT_EQ(kSteering.free_m(points, kPi, 5), 1.0) << "what lies behind does not count";
  EXPECT_EQ(kSteering.free_m(points, 0, 0.2), 0.2) << "no farther than asked";
  const std::vector<Vec2> beside{{0.8, 0.31}};
  EXPECT_EQ(kSteering.free_m(beside, 0, 5), 1.0);
  const std::vector<Vec2> touching{{0.1, 0.1}};
  EXPECT_EQ(kSteering.free_m(touching, 0, 5), 0.0);
}

TEST(Steering, TakesTheWantedDirectionWhenItIsFree) {
  EXPECT_EQ(kSteering.best({}, 0.4, 5).heading_rad, 0.4);
}

TEST(Steering, GoesRoundAPointOnTheShorterSide) {
  const std::vector<Vec2> points{{0.7, 0.1}};
  const FreeHeading way = kSteering.best(points, 0, 5);
  EXPECT_LT(way.heading_rad, -0.2);
  EXPECT_GT(way.heading_rad, -0.5);
  EXPECT_EQ(way.free_m, 1.0);
}

TEST(Steering, TakesTheFarthestWhenNothingIsFree) {
  std::vector<Vec2> ring;
  for (int k = 0; k < 60; ++k) {
    const double angle_rad = k * kPi / 30.0;
    const double radius_m = k == 20 ? 0.95 : 0.6;
    ring.push_back({radius_m * cos(angle_rad), radius_m * sin(angle_rad)});
  }
  const FreeHeading way = kSteering.best(ring, 0, 5);
  EXPECT_LT(way.free_m, 1.0);
  double most_m = 0;
  for (int k = 0; k < 72; ++k) {
    most_m = std::max(most_m, kSteering.free_m(ring, k * kPi / 36.0, 5));
  }
  EXPECT_NEAR(way.free_m, most_m, 1e-9);
}

TEST(Steering, AHandOnTheWallTurnsToTheFirstFreeDirection) {
  // A wall ahead, 0.5 m away: with the hand on the right it turns left until the wall lies beside.
  std::vector<Vec2> wall;
  for (int k = -40; k <= 40; ++k) wall.push_back({0.5, 0.05 * k});
  const FreeHeading left = kSteering.first(wall, 0, 1, 0.4);
  EXPECT_GT(left.heading_rad, deg_to_rad(50));
  EXPECT_LT(left.heading_rad, deg_to_rad(90));
  const FreeHeading right = kSteering.first(wall, 0, -1, 0.4);
  EXPECT_NEAR(right.heading_rad, -left.heading_rad, 1e-9);
}

}  // namespace
}  // namespace rave
