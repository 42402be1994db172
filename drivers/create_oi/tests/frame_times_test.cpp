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

/// The drift that is seen of a clock that is off by `drift_ppm`: of the frames `is_lost(i)` are
/// lost, and some stand still on the line for more than a period.
template <class IsLost>
double seen_drift_ppm(double drift_ppm, const IsLost& is_lost) {
  FrameTimes times(kPeriod_s);
  std::mt19937 random(3);
  std::exponential_distribution<double> delay(1 / 0.0005);
  std::bernoulli_distribution stands(0.02);
  double came_s = 0;
  for (int i = 0; i < 4000; ++i) {
    const double true_s = i * kPeriod_s / (1 + drift_ppm * 1e-6);
    came_s = std::max(came_s, true_s + delay(random) + (stands(random) ? 0.02 : 0));
    if (!is_lost(i)) (void)times.next(came_s);
  }
  return (kPeriod_s / times.measured_period_s() - 1) * 1e6;
}

TEST(FrameTimes, TheDriftIsThatOfTheClockWhateverFramesAreLostOrLate) {
  for (const double drift_ppm : {0.0, 200.0}) {
    EXPECT_NEAR(seen_drift_ppm(drift_ppm, [](int) { return false; }), drift_ppm, 50);
    EXPECT_NEAR(seen_drift_ppm(drift_ppm, [](int i) { return i % 7 == 3; }), drift_ppm, 50);
    EXPECT_NEAR(seen_drift_ppm(drift_ppm, [](int i) { return i % 50 < 5; }), drift_ppm, 50);
    // Silent for 0.3 s now and then, the last time 15 s before the end.
    EXPECT_NEAR(seen_drift_ppm(drift_ppm, [](int i) { return i < 3000 && i % 500 < 20; }),
                drift_ppm, 100);
  }
}

TEST(FrameTimes, FramesThatAreMissingInALongGapAreCounted) {
  FrameTimes times(kPeriod_s);
  for (int i = 0; i < 300; ++i) {
    if (i % 100 < 70 || i % 100 >= 90) (void)times.next(i * kPeriod_s);
  }
  EXPECT_EQ(times.missing(), 60U);
  EXPECT_NEAR(times.measured_period_s(), kPeriod_s, 1e-9);
}

}  // namespace
}  // namespace rave::oi
