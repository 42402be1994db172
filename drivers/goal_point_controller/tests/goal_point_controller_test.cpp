// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>

#include "programs/testing/driver_harness.hpp"
#include "rave/math/transform.hpp"

namespace rave {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class GoalPointTest : public ::testing::Test {
 protected:
  void SetUp() override {
    driver.params.set("max_speed_mps", 0.5)
        .set("max_turn_rate_radps", 1.5)
        .set("max_deceleration_mps2", 0.2)
        .set("tolerance_m", 0.02)
        .set("watchdog_s", 1.0);
    driver.start();
  }
  Command answer(const Command& goal, const Pose2& X_WR, double age_s = 0) {
    ControlInput input;
    input.command = goal;
    input.command_age_s = age_s;
    input.pose.x_m = X_WR.x;
    input.pose.y_m = X_WR.y;
    input.pose.yaw_rad = X_WR.yaw;
    return driver.control(input);
  }
  static double distance_m(const Pose2& X_WR, Vec2 p_WG) {
    return std::sqrt(squared_norm(p_WG - X_WR.position()));
  }

  testing::ControllerUnderTest driver{rave_register_plugin, "goal_point"};
};

TEST_F(GoalPointTest, ReachesGoalsAllAroundWithoutEverGoingAway) {
  for (int k = 0; k < 24; ++k) {
    const double bearing_rad = k * kPi / 12.0;
    const Vec2 p_WG{1.0 + 3.0 * cos(bearing_rad), -2.0 + 3.0 * sin(bearing_rad)};
    Pose2 X_WR{1, -2, 0.7};
    double before_m = distance_m(X_WR, p_WG);
    double fastest_mps = 0;
    double speed_mps = 0;
    int steps = 0;
    for (; steps < 3000; ++steps) {
      const Command out = answer(goal_command(p_WG.x, p_WG.y), X_WR);
      if (out == velocity_command(0, 0)) break;
      ASSERT_LE(std::abs(out.value[0]), 0.5 + 1e-12);
      ASSERT_LE(std::abs(out.value[1]), 1.5 + 1e-12);
      // Never faster than it can brake from.
      ASSERT_LE(out.value[0] * out.value[0], 2.0 * 0.2 * before_m + 1e-12);
      speed_mps = out.value[0];
      fastest_mps = std::max(fastest_mps, speed_mps);
      X_WR = integrate(X_WR, {out.value[0], 0, out.value[1]}, 0.01);
      const double now_m = distance_m(X_WR, p_WG);
      ASSERT_LE(now_m, before_m + 1e-12) << "goal " << k << ", step " << steps;
      before_m = now_m;
    }
    EXPECT_LE(before_m, 0.02) << "goal " << k;
    EXPECT_GT(fastest_mps, 0.49) << "goal " << k;
    EXPECT_LT(speed_mps, 0.03) << "it arrives slowly; goal " << k;
  }
}

TEST_F(GoalPointTest, FollowsTheLawWhileNothingIsLimited) {
  // e = 0.3, a = 0.5 with g = 1, k = 3: v = e cos a, w = 3 a + sin a cos a, within the limits only
  // if the turning rate allows, so scaled by 1.5 / w.
  const Command out = answer(goal_command(0.3 * cos(0.5), 0.3 * sin(0.5)), {});
  const double w_radps = 1.5 + sin(0.5) * cos(0.5);
  EXPECT_NEAR(out.value[0], 0.3 * cos(0.5) * 1.5 / w_radps, 1e-12);
  EXPECT_NEAR(out.value[1], 1.5, 1e-12);
}

TEST_F(GoalPointTest, TurnsOnTheSpotWhenTheGoalLiesBehind) {
  const Command out = answer(goal_command(-2, 0.5), {});
  EXPECT_EQ(out.value[0], 0);
  EXPECT_EQ(out.value[1], 1.5);
  EXPECT_EQ(answer(goal_command(-2, -0.5), {}).value[1], -1.5);
}

TEST_F(GoalPointTest, LeadsACarToGoalsAllAround) {
  driver.params.set("min_turn_radius_m", 0.8);
  driver.start();
  for (int k = 0; k < 48; ++k) {
    const double bearing_rad = k * kPi / 12.0;
    const double far_m = k < 24 ? 3.0 : 0.5;
    const Vec2 p_WG{far_m * cos(bearing_rad), far_m * sin(bearing_rad)};
    Pose2 X_WR{0, 0, 0};
    int steps = 0;
    for (; steps < 6000; ++steps) {
      const Command out = answer(goal_command(p_WG.x, p_WG.y), X_WR);
      if (out == velocity_command(0, 0)) break;
      ASSERT_LE(std::abs(out.value[1]) * 0.8, std::abs(out.value[0]) + 1e-12) << "a car cannot";
      X_WR = integrate(X_WR, {out.value[0], 0, out.value[1]}, 0.01);
    }
    EXPECT_LE(distance_m(X_WR, p_WG), 0.02) << "goal " << k;
  }
}

TEST_F(GoalPointTest, HonoursTheSpeedOfTheCommand) {
  EXPECT_NEAR(answer(goal_command(5, 0, 0.1), {}).value[0], 0.1, 1e-12);
  EXPECT_NEAR(answer(goal_command(5, 0, 7.0), {}).value[0], 0.5, 1e-12);
}

TEST_F(GoalPointTest, StopsThereAndWithoutAFreshGoal) {
  const Command stop = velocity_command(0, 0);
  EXPECT_EQ(answer(goal_command(0.01, 0.01), {}), stop);
  EXPECT_NE(answer(goal_command(2, 0), {}, 1.0), stop);
  EXPECT_EQ(answer(goal_command(2, 0), {}, 1.01), stop);
  EXPECT_EQ(answer({}, {}), stop);
  EXPECT_EQ(answer(velocity_command(2, 0), {}), stop);
}

TEST_F(GoalPointTest, StopsForWhatIsNotANumberAndSaysSoOnce) {
  EXPECT_EQ(answer(goal_command(kNaN, 0), {}), velocity_command(0, 0));
  EXPECT_EQ(answer(goal_command(2, 0), {0, 0, kNaN}), velocity_command(0, 0));
  ASSERT_EQ(driver.log.lines.size(), 1U);
  EXPECT_NE(driver.log.lines[0].find("not finite"), std::string::npos);
}

}  // namespace
}  // namespace rave
