// SPDX-License-Identifier: Apache-2.0
#include "../src/pose_gate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

using Verdict = SampleGate::Verdict;

/// A robot that drives along x, and what its pose source says of it.
class PoseGateTest : public ::testing::Test {
 protected:
  static constexpr double kSpeed_mps = 0.35;
  static constexpr double kTurn_radps = 2;

  /// The next pose, `x_m` and `turned_deg` off the true one.
  Verdict say(double x_m = 0, double turned_deg = 0, double variance_m2 = 0) {
    t_s_ += period_s;
    const PoseReading pose{kSpeed_mps * t_s_ + x_m, 0, deg_to_rad(turned_deg), variance_m2, 0};
    return gate.judge(SimTime{} + from_seconds(t_s_), &pose);
  }

  PoseGate gate{ReadingKind::kPose, {kSpeed_mps, kTurn_radps}};
  double period_s = 0.1;
  double t_s_ = 0;
};

TEST_F(PoseGateTest, WhatTheRobotCanHaveReachedPasses) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0, 0.02);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(say(noise(random), 200 * noise(random)), Verdict::kPass);
  // After a silence it may be farther away.
  t_s_ += 10;
  EXPECT_EQ(say(), Verdict::kPass);
  // A localisation that corrects itself.
  EXPECT_EQ(say(0.4, 15), Verdict::kPass);
}

TEST_F(PoseGateTest, OnePoseFarAwayIsRefusedAndSaysWhy) {
  ASSERT_EQ(say(), Verdict::kPass);
  ASSERT_EQ(say(), Verdict::kPass);
  EXPECT_EQ(say(500), Verdict::kRefuse);
  EXPECT_EQ(gate.reason(),
            "it says (500.11, 0.00) m, 0 deg, but was at (0.07, 0.00) m, 0 deg 0.10 s before, "
            "which 0.35 m/s and 115 deg/s do not explain (`pose_max_speed_mps`, "
            "`pose_max_turn_dps`)");
  EXPECT_EQ(say(), Verdict::kPass);
}

TEST_F(PoseGateTest, HeadingsThatAreTurnedNowAndThenAreRefusedForGood) {
  for (const double period : {0.01, 0.1, 0.2}) {
    period_s = period;
    gate.reset();
    for (int i = 0; i < 300; ++i) {
      EXPECT_EQ(say(0, i % 3 == 1 ? 180 : 0), i % 3 == 1 ? Verdict::kRefuse : Verdict::kPass);
    }
  }
}

TEST_F(PoseGateTest, PosesThatAgreeForHalfASecondAreANewPlace) {
  for (const double period : {0.01, 0.1, 1.0}) {
    period_s = period;
    gate.reset();
    t_s_ = 0;
    ASSERT_EQ(say(), Verdict::kPass);
    const int wanted = period == 0.01 ? 51 : period == 0.1 ? 6 : 5;
    for (int i = 1; i < wanted; ++i) EXPECT_EQ(say(30), Verdict::kRefuse) << i;
    EXPECT_EQ(say(30), Verdict::kAnew) << period;
    EXPECT_NE(gate.reason().find("the robot cannot have driven there from ("), std::string::npos)
        << gate.reason();
    EXPECT_EQ(say(30), Verdict::kPass);
    EXPECT_EQ(say(0), Verdict::kRefuse) << "where it was before";
  }
}

TEST_F(PoseGateTest, ThoseThatDoNotAgreeAreNoPlace) {
  ASSERT_EQ(say(), Verdict::kPass);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(say(30 + 10 * i), Verdict::kRefuse);
  // Nor are those with a good one between them.
  for (int i = 0; i < 4; ++i) EXPECT_EQ(say(30), Verdict::kRefuse);
  t_s_ = 0;
  gate.reset();
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(say(i % 5 == 0 ? 0 : 30), i % 5 == 0 ? Verdict::kPass : Verdict::kRefuse) << i;
  }
}

TEST_F(PoseGateTest, TheNoiseThatASourceStatesCounts) {
  ASSERT_EQ(say(), Verdict::kPass);
  EXPECT_EQ(say(5, 0, 4), Verdict::kPass);
  EXPECT_EQ(say(-5, 0, 0.01), Verdict::kRefuse);
}

TEST_F(PoseGateTest, WhatIsNotFiniteIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(say(nan), Verdict::kRefuse);
  EXPECT_EQ(gate.reason(), "a pose is not finite");
  EXPECT_EQ(say(), Verdict::kPass);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(say(nan), Verdict::kRefuse);
  EXPECT_EQ(say(), Verdict::kPass);
}

TEST(PoseReach, IsThatOfTheFileElseOfTheGuardElseLarge) {
  RobotType type;
  EXPECT_EQ(reach_of(type).max_speed_mps, 50);
  type.actuators.emplace_back();
  EXPECT_EQ(reach_of(type).max_speed_mps, 10);
  EXPECT_EQ(reach_of(type).max_turn_radps, 2 * kPi);
  type.guard = GuardSpec{};
  EXPECT_EQ(reach_of(type).max_speed_mps, 10);
  type.guard->max_speed_mps = 0.5;
  type.guard->max_turn_radps = 1;
  EXPECT_EQ(reach_of(type).max_speed_mps, 0.5);
  EXPECT_EQ(reach_of(type).max_turn_radps, 1);
  type.pose_max_speed_mps = 3;
  type.pose_max_turn_radps = 4;
  EXPECT_EQ(reach_of(type).max_speed_mps, 3);
  EXPECT_EQ(reach_of(type).max_turn_radps, 4);
}

}  // namespace
}  // namespace rave::sim
