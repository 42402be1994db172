// SPDX-License-Identifier: Apache-2.0
#include "create_oi/wheel_speeds.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rave::oi {
namespace {

TEST(WheelSpeeds, StraightAndTurning) {
  EXPECT_EQ(wheel_speeds(0.2, 0, 0.235, 500), (WheelSpeeds{200, 200}));
  EXPECT_EQ(wheel_speeds(0, 2, 0.235, 500), (WheelSpeeds{-235, 235}));
  EXPECT_EQ(wheel_speeds(-0.1, -1, 0.2, 500), (WheelSpeeds{0, -200}));
}

TEST(WheelSpeeds, TooMuchIsScaledSoThatTheCurveStays) {
  const WheelSpeeds speeds = wheel_speeds(1, 2, 0.235, 500);
  EXPECT_EQ(speeds.right_mmps, 500);
  EXPECT_NEAR(static_cast<double>(speeds.left_mmps) / speeds.right_mmps, (1 - 0.235) / (1 + 0.235),
              2e-3);
  EXPECT_EQ(wheel_speeds(-3, 0, 0.235, 500), (WheelSpeeds{-500, -500}));
}

TEST(WheelSpeeds, WhatIsNoNumberStops) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(wheel_speeds(kNone, 0, 0.235, 500), WheelSpeeds{});
  EXPECT_EQ(wheel_speeds(0, std::numeric_limits<double>::infinity(), 0.235, 500), WheelSpeeds{});
}

}  // namespace
}  // namespace rave::oi
