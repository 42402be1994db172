// SPDX-License-Identifier: Apache-2.0
#include "create_oi/frame_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rave::oi {
namespace {

constexpr double kPeriod_s = 0.015;

TEST(FrameTimes, EvenFramesAreTakenAsTheyCome) {
  FrameTimes times(kPeriod_s);
  for (int i = 0; i < 100; ++i) {
    EXPECT_NEAR(times.next(5 + i * kPeriod_s), 5 + i * kPeriod_s, 1e-9);
  }
  EXPECT_NEAR(times.measured_period_s(), kPeriod_s, 1e-9);
  EXPECT_EQ(times.missing(), 0U);
}

TEST(FrameTimes, JitterIsTakenOutAndDriftIsFollowed) {
  FrameTimes times(kPeriod_s);
  std::mt19937 random(1);
  std::exponential_distribution<double> delay(1 / 0.001);
  constexpr double kTrue_s = kPeriod_s / (1 + 200e-6);
  double worst_s = 0;
  double last_s = 0;
  for (int i = 0; i < 5000; ++i) {
    const double true_s = 100 + i * kTrue_s;
    const double came_s = true_s + delay(random);
    const double moment_s = times.next(came_s);
    EXPECT_GE(moment_s, last_s);
    EXPECT_LE(moment_s, came_s + 1e-12);
    last_s = moment_s;
    if (i > 200) worst_s = std::max(worst_s, std::abs(moment_s - true_s));
  }
  EXPECT_LT(worst_s, 0.0015) << "single frames came up to 8 ms late";
  EXPECT_NEAR((kPeriod_s / times.measured_period_s() - 1) * 1e6, 200, 60);
}

TEST(FrameTimes, ALostFrameIsCountedAndShiftsNothing) {
  FrameTimes times(kPeriod_s);
  for (int i = 0; i < 300; ++i) {
    if (i % 10 == 5) continue;
    EXPECT_NEAR(times.next(i * kPeriod_s), i * kPeriod_s, 1e-9);
  }
  EXPECT_EQ(times.missing(), 30U);
}

TEST(FrameTimes, AFrameThatStoodStillComesWithTheNextAndTimeDoesNotStepBack) {
  FrameTimes times(kPeriod_s);
  double last_s = 0;
  for (int i = 0; i < 200; ++i) {
    const double came_s = (i == 100 || i == 101 ? 102 : i) * kPeriod_s;
    const double moment_s = times.next(came_s);
    EXPECT_GE(moment_s, last_s);
    EXPECT_LE(moment_s, came_s + 1e-12);
    last_s = moment_s;
  }
  EXPECT_NEAR(last_s, 199 * kPeriod_s, 1e-3) << "it has found back";
}

}  // namespace
}  // namespace rave::oi
