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
    clock.add(device.clock(t), t + device.least_delay_s + jitter(random));
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

TEST(ClockOffset, ALateBurstChangesNothing) {
  Device device;
  ClockOffset clock;
  (void)worst_error(device, 100, 0, 20, clock);
  const double before_s = clock.offset_s(device.clock(20));
  for (int i = 0; i < 19; ++i) clock.add(device.clock(20 + 0.01 * i), 22);
  clock.add(device.clock(20.2), 20.2 + device.least_delay_s + 1e-4);
  EXPECT_NEAR(clock.offset_s(device.clock(20)), before_s, 1e-3);
  EXPECT_EQ(clock.restarts(), 0U);
}

TEST(ClockOffset, AClockThatStepsIsLearntAnew) {
  for (const double step_s : {-100.0, -0.7, 0.7, 100.0}) {
    Device device;
    ClockOffset clock;
    (void)worst_error(device, 100, 0, 20, clock);
    device.offset_s += step_s;
    for (double t = 20; t < 21; t += 0.01) clock.add(device.clock(t), t + device.least_delay_s);
    EXPECT_NEAR(clock.offset_s(device.clock(21)), device.truth(21), 2e-3) << step_s;
    EXPECT_EQ(clock.restarts(), 1U) << step_s;
  }
}

TEST(ClockOffset, OneSampleIsEnoughToBeginWith) {
  ClockOffset clock;
  EXPECT_FALSE(clock.known());
  clock.add(100, 103);
  EXPECT_TRUE(clock.known());
  EXPECT_EQ(clock.offset_s(100), 3);
  EXPECT_EQ(clock.drift_ppm(), 0);
  clock.add(100, 103.25);  // the same moment again, later
  EXPECT_EQ(clock.offset_s(), 3);
}

TEST(ClockOffset, WhatIsNoNumberIsIgnored) {
  ClockOffset clock;
  clock.add(std::numeric_limits<double>::quiet_NaN(), 1);
  clock.add(1, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(clock.known());
}

}  // namespace
}  // namespace rave::line
