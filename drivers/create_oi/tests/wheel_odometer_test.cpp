// SPDX-License-Identifier: Apache-2.0
#include "create_oi/wheel_odometer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::oi {
namespace {

constexpr double kFrame_s = 0.015;

/// Turns wheels and reads their counters as a robot does.
class Wheels {
 public:
  explicit Wheels(double zero_m = 0) : left_m_(zero_m), right_m_(zero_m) {}
  /// Drives for some frames.
  void drive(WheelOdometer& odometer, double left_mps, double right_mps, int frames) {
    for (int i = 0; i < frames; ++i) {
      left_m_ += left_mps * kFrame_s;
      right_m_ += right_mps * kFrame_s;
      t_s_ += kFrame_s;
      EXPECT_TRUE(read(odometer));
    }
  }
  bool read(WheelOdometer& odometer) {
    return odometer.step(counts(left_m_), counts(right_m_), t_s_);
  }
  void wait(double s) { t_s_ += s; }
  void restart() { left_m_ = right_m_ = 0; }
  [[nodiscard]] double t_s() const { return t_s_; }

 private:
  static std::uint16_t counts(double m) {
    return static_cast<std::uint16_t>(
        static_cast<std::int64_t>(std::floor(m * WheelOdometer::Options{}.counts_per_m)));
  }
  double left_m_;
  double right_m_;
  double t_s_ = 50;
};

TEST(WheelOdometer, AMetreStraightAndAQuarterTurn) {
  WheelOdometer odometer({});
  Wheels wheels(7);
  wheels.drive(odometer, 0, 0, 1);
  wheels.drive(odometer, 0.25, 0.25, 267);  // 1.00125 m
  OdometryReading reading = odometer.reading();
  EXPECT_NEAR(reading.x_m, 1.00125, 1e-3);
  EXPECT_NEAR(reading.y_m, 0, 1e-3);
  EXPECT_NEAR(reading.v_mps, 0.25, 0.005);
  EXPECT_NEAR(reading.w_radps, 0, 0.05);
  const double rim_mps = 0.2;
  const int frames = static_cast<int>(std::lround(kPi / 2 * 0.235 / 2 / rim_mps / kFrame_s));
  wheels.drive(odometer, -rim_mps, rim_mps, frames);
  reading = odometer.reading();
  EXPECT_NEAR(reading.yaw_rad, frames * kFrame_s * 2 * rim_mps / 0.235, 0.01);
  EXPECT_NEAR(reading.x_m, 1.00125, 2e-3);
  EXPECT_NEAR(reading.w_radps, 2 * rim_mps / 0.235, 0.05);
}

TEST(WheelOdometer, CountersRollOverBothWays) {
  const double per_turn_m = 65536 / WheelOdometer::Options{}.counts_per_m;  // 29 m
  WheelOdometer forward({});
  Wheels wheels(per_turn_m - 0.5);
  wheels.drive(forward, 0.4, 0.4, 167);
  EXPECT_NEAR(forward.reading().x_m, 166 * 0.4 * kFrame_s, 2e-3);
  WheelOdometer back({});
  Wheels reversed(0.5);
  reversed.drive(back, -0.4, -0.4, 167);
  EXPECT_NEAR(back.reading().x_m, -166 * 0.4 * kFrame_s, 2e-3);
  EXPECT_EQ(back.disbelieved() + forward.disbelieved(), 0U);
}

TEST(WheelOdometer, TheSquareOfDoubtGrowsWithTheWay) {
  WheelOdometer odometer({});
  Wheels wheels;
  wheels.drive(odometer, 0.3, 0.3, 223);  // 1 m
  const OdometryReading one = odometer.reading();
  // Two wheels of deviation 0.02 m / sqrt(m).
  EXPECT_NEAR(one.variance_yaw_rad2, 2 * 0.02 * 0.02 / (0.235 * 0.235), 2e-4);
  wheels.drive(odometer, 0.3, 0.3, 223);
  EXPECT_NEAR(odometer.reading().variance_yaw_rad2, 2 * one.variance_yaw_rad2, 2e-4);
  EXPECT_GT(odometer.reading().variance_xy_m2, 3 * one.variance_xy_m2) << "the heading adds";
  const OdometryReading before = odometer.reading();
  wheels.drive(odometer, 0, 0, 1000);
  EXPECT_EQ(odometer.reading().variance_xy_m2, before.variance_xy_m2);
}

TEST(WheelOdometer, CountsThatNoWheelMakesAreNotBelieved) {
  WheelOdometer odometer({});
  Wheels wheels;
  wheels.drive(odometer, 0.2, 0.2, 100);
  const OdometryReading before = odometer.reading();
  EXPECT_FALSE(odometer.step(9000, 500, wheels.t_s() + kFrame_s));
  EXPECT_EQ(odometer.reading().x_m, before.x_m);
  wheels.drive(odometer, 0.2, 0.2, 100);
  EXPECT_NEAR(odometer.reading().x_m, 199 * 0.2 * kFrame_s, 2e-3);
  EXPECT_EQ(odometer.disbelieved(), 1U);
  EXPECT_EQ(odometer.restarts(), 0U);
}

TEST(WheelOdometer, WhatIsDrivenDuringAShortPauseIsKept) {
  WheelOdometer odometer({});
  Wheels wheels(3);
  wheels.drive(odometer, 0.2, 0.2, 100);
  const double before_m = odometer.reading().x_m;
  wheels.wait(1);
  wheels.drive(odometer, 0.5, 0.5, 20);
  EXPECT_NEAR(odometer.reading().x_m, before_m + 20 * 0.5 * kFrame_s, 2e-3);
  EXPECT_EQ(odometer.restarts(), 0U);
}

TEST(WheelOdometer, ARestartKeepsThePoseAndDoubtsIt) {
  for (const double pause_s : {0.0, 2.0, 60.0}) {
    WheelOdometer odometer({});
    Wheels wheels;
    wheels.drive(odometer, 0.4, 0.4, 200);
    const OdometryReading before = odometer.reading();
    wheels.wait(pause_s);
    wheels.restart();
    for (int i = 0; i < 10; ++i) {
      wheels.wait(kFrame_s);
      (void)wheels.read(odometer);
    }
    EXPECT_EQ(odometer.restarts(), 1U) << pause_s;
    const OdometryReading after = odometer.reading();
    EXPECT_EQ(after.x_m, before.x_m);
    EXPECT_EQ(after.v_mps, 0);
    EXPECT_GT(after.variance_xy_m2, before.variance_xy_m2 + pause_s * pause_s / 4 / 3 * 0.99);
    wheels.drive(odometer, 0.4, 0.4, 100);
    EXPECT_NEAR(odometer.reading().x_m, before.x_m + 100 * 0.4 * kFrame_s, 2e-3);
  }
}

TEST(WheelOdometer, FramesOfOneMomentGiveNoInfiniteSpeed) {
  WheelOdometer odometer({});
  for (std::uint16_t i = 0; i < 10; ++i) EXPECT_TRUE(odometer.step(i, i, 3.0));
  EXPECT_EQ(odometer.reading().v_mps, 0);
  EXPECT_GT(odometer.reading().x_m, 0);
}

}  // namespace
}  // namespace rave::oi
