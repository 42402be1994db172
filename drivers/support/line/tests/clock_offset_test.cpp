// SPDX-License-Identifier: Apache-2.0
#include "rave/line/clock_offset.hpp"

#include <gtest/gtest.h>

#include <random>

namespace rave::line {
namespace {

/// A device whose clock is off and runs at its own speed, and a way to the host that takes time.
struct Device {
  double offset_s = 3;    ///< Host minus device at host time 0.
  double drift = 200e-6;  ///< How much faster the device's clock runs.
  double least_delay_s = 1e-3;
  double mean_jitter_s = 4e-3;

  [[nodiscard]] double clock(double host_s) const { return host_s * (1 + drift) - offset_s; }
  /// What offset + smallest delay is at a moment.
  [[nodiscard]] double truth(double host_s) const { return host_s - clock(host_s) + least_delay_s; }
};

/// Largest error of the estimate after `settle_s` of `length_s` at `rate_hz`.
double worst_error(const Device& device, double rate_hz, double settle_s, double length_s,
                   ClockOffset& clock) {
  std::mt19937_64 random(7);
  std::exponential_distribution<double> jitter(1 / device.mean_jitter_s);
  double worst = 0;
  for (double t = 0; t < length_s; t += 1 / rate_hz) {
    (void)clock.add(device.clock(t), t + device.least_delay_s + jitter(random));
    const double error = clock.offset_s(device.clock(t)) - device.truth(t);
    if (t >= settle_s) worst = std::max(worst, std::abs(error));
  }
  return worst;
}

TEST(ClockOffset, FollowsAClockThatDriftsAndIsOff) {
  for (const double drift : {200e-6, -200e-6, 0.0}) {
    for (const double rate_hz : {10.0, 100.0}) {
      Device device;
      device.drift = drift;
      ClockOffset clock;
      EXPECT_LT(worst_error(device, rate_hz, 2, 600, clock), 2e-3) << drift << ' ' << rate_hz;
      EXPECT_NEAR(clock.drift_ppm(), -drift * 1e6, 40);
      EXPECT_EQ(clock.restarts(), 0U);
    }
  }
}

TEST(ClockOffset, LateSamplesNeverBecomePartOfTheOffset) {
  // As a queue on the way that fills up does it: fast, slowly, and at once.
  for (const double growing_s : {0.001, 5.0, 60.0, 300.0}) {
    Device device;
    ClockOffset clock;
    (void)worst_error(device, 20, 0, 40, clock);
    constexpr double kLag_s = 3;
    for (double t = 40; t < 40 + growing_s + 600; t += 0.05) {
      const double lag_s = kLag_s * std::min(1.0, (t - 40) / growing_s);
      const double sent_s = t - lag_s;
      EXPECT_EQ(clock.add(device.clock(sent_s), t + device.least_delay_s),
                ClockOffset::Sample::kGood);
      const double error_s = clock.offset_s(device.clock(sent_s)) - device.truth(sent_s);
      // The drift that a quartz may have, until the lag is beyond doubt.
      // And that of its drift for ten minutes.
      ASSERT_LT(error_s, 5e-3 + 1e-3 * std::min(t - 40, growing_s) + 100e-6 * (t - 40))
          << growing_s << " at " << t;
    }
    EXPECT_EQ(clock.restarts(), 0U);
    // When the queue is empty again, ages are right again.
    device.mean_jitter_s = 1e-6;
    for (double t = 1000; t < 1010; t += 0.05) {
      (void)clock.add(device.clock(t), t + device.least_delay_s);
      EXPECT_LT(clock.offset_s(device.clock(t)) - device.truth(t), 5e-3);
    }
  }
}

TEST(ClockOffset, ADriftIsFollowedForAnHour) {
  for (const double drift : {150e-6, -150e-6}) {
    Device device;
    device.drift = drift;
    ClockOffset clock;
    EXPECT_LT(worst_error(device, 10, 40, 3600, clock), 5e-3) << drift;
    EXPECT_EQ(clock.restarts(), 0U);
  }
}

TEST(ClockOffset, AClockThatIsSetForwardIsLearntAnewAfterTenSamplesThatAgree) {
  for (const double step_s : {0.7, 100.0}) {
    Device device;
    ClockOffset clock;
    (void)worst_error(device, 100, 0, 20, clock);
    device.offset_s -= step_s;
    for (int i = 0; i < 10; ++i) {
      const double t = 20 + 0.01 * i;
      EXPECT_EQ(clock.add(device.clock(t), t + device.least_delay_s),
                i < 9 ? ClockOffset::Sample::kEarly : ClockOffset::Sample::kSet);
    }
    EXPECT_NEAR(clock.offset_s(device.clock(20.09)), device.truth(20.09), 2e-3) << step_s;
    EXPECT_EQ(clock.restarts(), 1U) << step_s;
  }
}

TEST(ClockOffset, AStampFromTheFutureIsNotBelieved) {
  Device device;
  ClockOffset clock;
  (void)worst_error(device, 100, 0, 20, clock);
  const double before_s = clock.offset_s(device.clock(20));
  // Many, but no two that agree.
  for (int i = 1; i < 50; ++i) {
    EXPECT_EQ(clock.add(device.clock(20) + 2 * i, 20 + 0.01 * i), ClockOffset::Sample::kEarly);
  }
  EXPECT_EQ(clock.add(device.clock(20.5), 20.5 + device.least_delay_s), ClockOffset::Sample::kGood);
  EXPECT_NEAR(clock.offset_s(device.clock(20.5)), before_s, 1e-3);
  EXPECT_EQ(clock.restarts(), 0U);
}

TEST(ClockOffset, ALateFirstSampleIsNoClockThatWasSet) {
  Device device;
  ClockOffset clock;
  (void)clock.add(device.clock(0), 1.5);
  EXPECT_EQ(clock.add(device.clock(0.1), 0.1 + device.least_delay_s), ClockOffset::Sample::kGood);
  EXPECT_NEAR(clock.offset_s(device.clock(0.1)), device.truth(0.1), 1e-6);
  EXPECT_EQ(clock.restarts(), 0U);
}

TEST(ClockOffset, OneSampleIsEnoughToBeginWith) {
  ClockOffset clock;
  EXPECT_FALSE(clock.known());
  (void)clock.add(100, 103);
  EXPECT_TRUE(clock.known());
  EXPECT_EQ(clock.offset_s(100), 3);
  EXPECT_EQ(clock.drift_ppm(), 0);
  (void)clock.add(100, 103.25);  // the same moment again, later
  EXPECT_EQ(clock.offset_s(), 3);
}

TEST(ClockOffset, WhatIsNoNumberIsIgnored) {
  ClockOffset clock;
  (void)clock.add(std::numeric_limits<double>::quiet_NaN(), 1);
  (void)clock.add(1, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(clock.known());
}

}  // namespace
}  // namespace rave::line
