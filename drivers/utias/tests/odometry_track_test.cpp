// SPDX-License-Identifier: Apache-2.0
#include "utias/odometry_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "recorded.hpp"

namespace rave::utias {
namespace {

TEST(OdometryTrack, HoldsTheLastCommand) {
  const std::vector<OdometrySample> log = {{10, 1, 0}, {20, 2, 0}};
  EXPECT_FALSE(command_at(log, 9));
  EXPECT_EQ(command_at(log, 10)->v_mps, 1);
  EXPECT_EQ(command_at(log, 19)->v_mps, 1);
  EXPECT_EQ(command_at(log, 1'000'000)->v_mps, 2);
}

TEST(OdometryTrack, MovesOnExactArcs) {
  // Half a circle of radius 0.25 m in one command held for pi seconds.
  const std::vector<OdometrySample> log = {{0, 0.25, 1.0}};
  const auto end_ns = static_cast<std::int64_t>(std::numbers::pi * 1e9);
  const auto track = integrate_odometry(log, {1, 2, 0}, 0, end_ns);
  EXPECT_EQ(track.size(), 33U) << "every 0.1 s, and the end";
  EXPECT_EQ(track.back().t_ns, end_ns);
  EXPECT_NEAR(track.back().pose.x, 1, 1e-8);
  EXPECT_NEAR(track.back().pose.y, 2.5, 1e-8);
  EXPECT_NEAR(std::abs(track.back().pose.yaw), std::numbers::pi, 1e-8);
}

TEST(OdometryTrack, StandsStillBeforeTheFirstCommandAndTakesUpTheOneInForce) {
  const std::vector<OdometrySample> log = {{kSecond_ns, 1, 0}, {2 * kSecond_ns, -1, 0}};
  const auto whole = integrate_odometry(log, {}, 0, 4 * kSecond_ns);
  EXPECT_NEAR(whole.back().pose.x, 1 - 2, 1e-12);
  const auto late = integrate_odometry(log, {}, 3 * kSecond_ns / 2, 2 * kSecond_ns);
  EXPECT_NEAR(late.back().pose.x, 0.5, 1e-12);
  EXPECT_TRUE(integrate_odometry(log, {}, 1, 0).empty());
}

// The figures were computed by an independent program: integrated alone the commands end 0.5 to
// 0.7 m beside the captured pose after 120 s, those of robot 3, which turns most, 2.3 m.
TEST(OdometryTrack, CommandsAloneLeadAstray) {
  const Dataset data = recorded("100-220");
  const std::map<int, double> expected_m = {{1, 0.71}, {2, 0.66}, {3, 2.33}, {4, 0.60}, {5, 0.54}};
  for (const RobotLog& robot : data.robots) {
    const auto start = robot.poses.interpolate(data.start_ns);
    ASSERT_TRUE(start);
    const auto track = integrate_odometry(robot.odometry, *start, data.start_ns, data.end_ns);
    const Vec2 truth = robot.poses.interpolate(data.end_ns)->position();
    const double error_m = std::sqrt(squared_norm(track.back().pose.position() - truth));
    EXPECT_NEAR(error_m, expected_m.at(robot.subject), 0.02) << "robot " << robot.subject;
  }
}

}  // namespace
}  // namespace rave::utias
