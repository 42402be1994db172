// SPDX-License-Identifier: Apache-2.0
// What the guard adds for all that it does not know yet: how old the pose is, how long a step
// takes, where others go meanwhile.
#include <gtest/gtest.h>

#include <cmath>

#include "../src/robot_guard.hpp"
#include "guard_inputs.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

constexpr double kBody_m = 0.2;  // as of input()

GuardSpec in_square() {
  GuardSpec spec;
  spec.fence_W = square(2);
  return spec;
}

/// The speed from which a robot stands after this way, if it goes on for `delay_s` first.
double allowed_mps(double way_m, double delay_s, double deceleration_mps2) {
  const double a = deceleration_mps2;
  return std::sqrt(a * a * delay_s * delay_s + 2 * a * way_m) - a * delay_s;
}

TEST(GuardAge, TheSpeedTowardsTheFenceIsThatOfTheFormula) {
  struct Case {
    double dt_s;
    double reaction_s;
    double pose_age_s;
    double deceleration_mps2;
  };
  for (const Case& c :
       {Case{0.01, 0.1, 0, 0.5}, Case{0.5, 0.1, 0, 0.5}, Case{0.01, 0.6, 0, 0.5},
        Case{0.01, 0.1, 0.4, 0.5}, Case{0.02, 0.2, 1.5, 0.5}, Case{0.01, 0.1, 0.2, 2}}) {
    GuardSpec spec = in_square();
    spec.reaction_s = c.reaction_s;
    spec.deceleration_mps2 = c.deceleration_mps2;
    const double delay_s = c.dt_s + c.reaction_s + c.pose_age_s;
    const double v_mps = allowed_mps(2 - kBody_m, delay_s, c.deceleration_mps2);
    for (const double sign : {1.0, -1.0}) {
      GuardInput in = input(sign * 3, 0);
      in.dt_s = c.dt_s;
      in.pose_age_s = c.pose_age_s;
      const GuardOutput output = guard(spec, in);
      EXPECT_TRUE(output.by(GuardLimit::kFence));
      EXPECT_NEAR(output.command.value[0], sign * v_mps, 1e-4)
          << "step " << c.dt_s << " s, age " << c.pose_age_s << " s";
    }
  }
}

TEST(GuardAge, WhoIsMeasuredFasterThanItIsToldHasGoneFartherSince) {
  // Along the fence, 0.1 m from it, and told to turn towards it slowly.
  GuardInput in = input(0.1, 0.2, {0, 1.7, 0});
  in.pose_age_s = 1;
  EXPECT_EQ(guard(in_square(), in).acted, 0U);
  in.velocity = {0.5, 0, 0};
  const GuardOutput output = guard(in_square(), in);
  EXPECT_TRUE(output.by(GuardLimit::kFence));
  EXPECT_LT(output.command.value[0], 0.1);
}

TEST(GuardAge, WhoWasToldToGoFasterHasGoneFartherSince) {
  GuardInput in = input(3, 0);
  in.pose_age_s = 0.4;
  in.fastest_mps = 1.5;
  // It may be 0.6 m ahead of its pose already.
  EXPECT_NEAR(guard(in_square(), in).command.value[0], allowed_mps(1.8 - 0.6, 0.11, 0.5), 1e-4);
  in.command = velocity_command(1, 0);
  EXPECT_NEAR(guard_reach_m({}, in), 1.5 * 0.51 + 1.5 * 1.5, 1e-9);
}

TEST(GuardAge, WhatWasToldBeforeThePoseWasTakenIsNoPartOfTheWaySince) {
  RobotGuard robot;
  GuardInput in = input(1.5, 0, {-1.7, 0, 0});
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U);
  in.command = velocity_command(0.2, 0);
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U);
  in.X_WR.x = 1.3;
  in.pose_age_s = 0.4;
  EXPECT_NE(robot.limit(in_square(), in).acted, 0U) << "it may have gone 0.6 m since";
  in.pose_stamp = SimTime{1};
  in.command = velocity_command(0.1, 0);
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U) << "0.2 m/s at most since this one";
}

TEST(GuardAge, TheFenceHoldsHoweverSeldomThePoseComes) {
  for (const int steps_per_pose : {1, 10, 45}) {
    RobotGuard robot;
    GuardInput in = input(1.0, 0);
    double x_m = 0;
    double v_mps = 0;
    for (int step = 0; step < 6000; ++step) {
      if (step % steps_per_pose == 0) {
        in.X_WR.x = x_m;
        in.pose_stamp = SimTime{step};
        in.velocity = {v_mps, 0, 0};
      }
      in.pose_age_s = in.dt_s * (step % steps_per_pose);
      v_mps = robot.limit(in_square(), in).command.value[0];
      x_m += v_mps * in.dt_s;
      ASSERT_LE(x_m, 2 - kBody_m + 1e-3) << steps_per_pose << ", step " << step;
    }
    EXPECT_GT(x_m, 1.7) << "it came near, so it was the guard that held it";
  }
}

TEST(GuardContact, AfterOneTheNextStepIsNoLongerThanTheFreeWay) {
  // Parallel to the fence, which is 3 mm beside the body.
  GuardInput in = input(0.5, 0, {0, 2 - kBody_m - 0.003, 0});
  EXPECT_EQ(guard(in_square(), in).acted, 0U);
  in.touching = true;
  const GuardOutput output = guard(in_square(), in);
  EXPECT_TRUE(output.by(GuardLimit::kFence));
  EXPECT_NEAR(output.command.value[0], 0.3, 1e-4);
  in.command = velocity_command(-0.5, 0);
  EXPECT_NEAR(guard(in_square(), in).command.value[0], -0.3, 1e-4);
  in.X_WR.yaw = -kPi / 2;
  in.command = velocity_command(0.5, 0);
  EXPECT_EQ(guard(in_square(), in).acted, 0U) << "away from the fence";
}

TEST(GuardContact, WhoSlidOutALittleSlidesNoFarther) {
  GuardInput in = input(0.5, 0, {0, 2 - kBody_m + 0.003, 0});
  EXPECT_EQ(guard(in_square(), in).acted, 0U);
  in.touching = true;
  EXPECT_EQ(guard(in_square(), in).command.value[0], 0);
  in.X_WR.yaw = -kPi / 4;
  EXPECT_EQ(guard(in_square(), in).acted, 0U) << "inward";
}

TEST(GuardContact, WhoWasMadeToStandAtAWallStillTouchesIt) {
  RobotGuard robot;
  GuardInput in = input(0.5, 0, {0, 2 - kBody_m, 0});
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U);
  in.touching = true;
  EXPECT_EQ(robot.limit(in_square(), in).command.value[0], 0);
  // It does not move, so nothing limits it.
  in.touching = false;
  for (int step = 0; step < 3; ++step) {
    EXPECT_EQ(robot.limit(in_square(), in).command.value[0], 0) << step;
  }
  // Once it has turned the wall may be elsewhere.
  in.command = velocity_command(0, 1);
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U);
  in.command = velocity_command(0.5, 0);
  EXPECT_EQ(robot.limit(in_square(), in).acted, 0U);
}

TEST(GuardOthers, OneThatPassesQuicklyIsMetInBetween) {
  GuardSpec spec;
  spec.separation_m = 0.3;
  spec.reaction_s = 0.5;
  // It crosses the way at right angles and is far enough away before and after.
  const GuardNeighbour other{&disc(), {0.6, -1, 0}, {0, 4, 0}};
  GuardInput in = input(0.003, 0);
  in.neighbours = std::span(&other, 1);
  const GuardOutput output = guard(spec, in);
  EXPECT_TRUE(output.by(GuardLimit::kSeparation));
  EXPECT_EQ(output.command.value[0], 0);
}

TEST(GuardOthers, AreLookedForAsFarAsTheRobotGoesUntilItStands) {
  GuardSpec spec;
  spec.separation_m = 0.3;
  GuardInput in = input(1, 0);
  in.pose_age_s = 0.5;
  // 1 m/s for 10 ms, 0.1 s and 0.5 s, then 1 m of braking with 0.5 m/s2.
  EXPECT_NEAR(guard_reach_m(spec, in), 0.3 + 0.61 + 1, 1e-12);
  in.velocity = {-2, 0, 0};
  EXPECT_NEAR(guard_reach_m(spec, in), 0.3 + 2 * 0.61 + 4, 1e-12);
  in.command = velocity_command(1e300, 0);
  EXPECT_NEAR(guard_reach_m(spec, in), 0.3 + 20, 1e-9) << "nothing on wheels needs more";
  in.command = velocity_command(std::nan(""), 0);
  in.velocity = {};
  EXPECT_EQ(guard_reach_m(spec, in), 0.3);
}

}  // namespace
}  // namespace rave::sim
