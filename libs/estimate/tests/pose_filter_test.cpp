// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/pose_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/estimate/team_filter.hpp"
#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

constexpr Vec2 kTubes_W[] = {{3, 0}, {0, 3}, {-3, -2}, {2, -3}};

/// What a robot at `X_WR` reads of a place, without noise.
struct Sighting {
  double range_m = 0;
  double bearing_rad = 0;
};
Sighting sighting_of(Vec2 p_W, const Pose2& X_WR) {
  const Vec2 to_W = p_W - X_WR.position();
  return {std::sqrt(squared_norm(to_W)), atan2(to_W.y, to_W.x) - X_WR.yaw};
}

TEST(PoseFilter, ANullCommandMovesNothingAndAStraightOneForwards) {
  PoseFilter filter({}, {}, {1, 2, kPi / 2}, 0.01, 0.01);
  filter.move(0, 0, 5);
  EXPECT_DOUBLE_EQ(filter.pose().x, 1);
  filter.move(0.2, 0, 5);
  EXPECT_NEAR(filter.pose().x, 1, 1e-12);
  EXPECT_NEAR(filter.pose().y, 3, 1e-12);
}

TEST(PoseFilter, UncertaintyGrowsWithTheWayAndMoreWithTurning) {
  PoseFilter still({}, {}, {}, 0.01, 0.01);
  PoseFilter straight = still;
  PoseFilter turning = still;
  for (int i = 0; i < 100; ++i) {
    still.move(0, 0, 0.1);
    straight.move(0.2, 0, 0.1);
    turning.move(0.2, 0.5, 0.1);
  }
  EXPECT_GT(straight.place().covariance[0], still.place().covariance[0]);
  EXPECT_GT(turning.heading_variance(), 10 * straight.heading_variance());
}

TEST(PoseFilter, LandmarksCorrectAWrongStartAndTheShareOfTurning) {
  MotionModel motion;
  PoseFilter filter(motion, {}, {0.2, -0.15, 0.1}, 0.3, 0.2);
  Pose2 truth{};
  const double share = 0.86;
  for (int step = 0; step < 2000; ++step) {
    const double w_radps = 0.4;
    filter.move(0.1, w_radps, 0.1);
    const double turned_rad = share * w_radps * 0.1;
    truth.x += 0.01 * cos(truth.yaw + 0.5 * turned_rad);
    truth.y += 0.01 * sin(truth.yaw + 0.5 * turned_rad);
    truth.yaw += turned_rad;
    if (step % 5 != 0) continue;
    const Vec2 tube_W = kTubes_W[(step / 5) % 4];
    const Sighting seen = sighting_of(tube_W, truth);
    EXPECT_TRUE(filter.see({tube_W, {}}, seen.range_m, seen.bearing_rad)) << step;
  }
  EXPECT_NEAR(filter.pose().x, truth.x, 0.02);
  EXPECT_NEAR(filter.pose().y, truth.y, 0.02);
  EXPECT_NEAR(std::remainder(filter.pose().yaw - truth.yaw, 2 * kPi), 0, 0.01);
  EXPECT_NEAR(filter.turning_share(), share, 0.02);
}

TEST(PoseFilter, WhatCannotBeIsRefused) {
  PoseFilter filter({}, {}, {}, 0.05, 0.05);
  const Pose2 before = filter.pose();
  EXPECT_FALSE(filter.see({{3, 0}, {}}, 5, 0)) << "two metres too far";
  EXPECT_FALSE(filter.see({{3, 0}, {}}, 3, 1)) << "a radian beside it";
  EXPECT_FALSE(filter.see({{3, 0}, {}}, std::numeric_limits<double>::quiet_NaN(), 0));
  EXPECT_FALSE(filter.see({{0, 0}, {}}, 0.1, 0)) << "the robot is there itself";
  EXPECT_EQ(filter.pose(), before);
  EXPECT_TRUE(filter.see({{3, 0}, {}}, 3.1, 0.01));
}

TEST(PoseFilter, WhoIsRefusedAgainAndAgainDoubtsHimself) {
  PoseFilter filter({}, {}, {}, 0.02, 0.02);
  const Pose2 truth{1.5, 0.5, 0.3};  // It was carried away.
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec2 tube_W = kTubes_W[i % 4];
    const Sighting seen = sighting_of(tube_W, truth);
    if (!filter.see({tube_W, {}}, seen.range_m, seen.bearing_rad)) ++refused;
  }
  EXPECT_GT(refused, 4);
  EXPECT_NEAR(filter.pose().x, truth.x, 0.1);
  EXPECT_NEAR(filter.pose().y, truth.y, 0.1);
}

TEST(TeamFilter, ACommandShowsAfterItsDelay) {
  MotionModel motion;
  motion.delay_s = 0.25;
  TeamFilter team(motion, {});
  team.add({}, 0.01, 0.01, 10);
  team.command(0, 10, 0.2, 0);
  team.command(0, 12, 0, 0);
  team.advance(0, 10.25);
  EXPECT_EQ(team.filter(0).pose().x, 0);
  team.advance(0, 11.25);
  EXPECT_NEAR(team.filter(0).pose().x, 0.2, 1e-9);
  team.advance(0, 20);
  EXPECT_NEAR(team.filter(0).pose().x, 0.4, 1e-9);
  EXPECT_NEAR(team.blind_s(0), 10, 1e-9);
}

TEST(TeamFilter, ARobotThatSeesNothingIsCorrectedByOneThatSeesIt) {
  TeamFilter team({}, {});
  team.add({0, 0, 0}, 0.02, 0.02, 0);
  team.add({2.3, 0.2, 1}, 0.4, 0.4, 0);
  for (int i = 1; i <= 20; ++i) EXPECT_TRUE(team.see_robot(0, 1, 0.1 * i, 2.0, 0)) << i;
  EXPECT_NEAR(team.filter(1).pose().x, 2, 0.1);
  EXPECT_NEAR(team.filter(1).pose().y, 0, 0.1);
  EXPECT_LT(std::abs(team.filter(0).pose().x), 0.1);
  EXPECT_EQ(team.blind_s(0), 0);
  EXPECT_NEAR(team.blind_s(1), 2, 1e-9) << "it saw nothing itself";
}

}  // namespace
}  // namespace rave::estimate
