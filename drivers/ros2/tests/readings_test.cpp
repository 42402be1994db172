// SPDX-License-Identifier: Apache-2.0
#include "ros2/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/bus/sequence.hpp"
#include "rave/math/scalar.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ros2::LaserScan scan_of(std::vector<float>& ranges) {
  ros2::LaserScan scan{};
  scan.angle_min = -0.5F;
  scan.angle_max = 0.5F;
  scan.angle_increment = 0.25F;
  scan.range_min = 0.25F;
  scan.range_max = 8;
  bus::borrow(scan.ranges, ranges);
  return scan;
}

TEST(Ros2Readings, RangesAsRep117HasThem) {
  std::vector<float> sent{kInf, 2.5F, -kInf, 0.1F, 2};
  const ros2::LaserScan scan = scan_of(sent);
  const Fan fan = fan_of(scan);
  EXPECT_EQ(bearings_of(fan), (std::vector<double>{-0.5, -0.25, 0, 0.25, 0.5}));
  std::vector<float> got(5);
  ASSERT_TRUE(ranges_of(scan, fan, got));
  EXPECT_EQ(got, (std::vector<float>{kInf, 2.5F, 0.25F, 0.25F, 2}));
  EXPECT_EQ(range_of(8.5F, 0.25, 8), kInf) << "beyond what it can measure";
  for (const float bad : {kNan, -0.1F, -1.0F, -1e30F, 0.0F, -0.0F}) {
    EXPECT_TRUE(std::isnan(range_of(bad, 0.25, 8))) << bad << " is not free space";
    EXPECT_TRUE(std::isnan(range_of(bad, 0, 8))) << bad;
  }
  EXPECT_EQ(range_of(0, 0.25, 8, Zero::kNoReturn), kInf) << "who says so";
  EXPECT_TRUE(std::isnan(range_of(kNan, 0.25, 8, Zero::kNoReturn)));
  sent[1] = 0;
  ASSERT_TRUE(ranges_of(scan, fan, got));
  EXPECT_TRUE(std::isnan(got[1]));
}

TEST(Ros2Readings, AScanWithoutAnyReadingIsRefused) {
  std::vector<float> sent{kNan, 0, -1, kNan, -0.5F};
  const ros2::LaserScan dead = scan_of(sent);
  std::vector<float> got(5);
  EXPECT_EQ(ranges_of(dead, fan_of(dead), got).error().message,
            "no ray has a valid reading: all are NaN, 0 or negative, as if the scanner did not "
            "turn; no return is +infinity (REP-117)");
  for (const float one : {kInf, -kInf, 0.3F, 100.0F}) {
    std::vector<float> alive{kNan, 0, -1, kNan, one};
    const ros2::LaserScan scan = scan_of(alive);
    EXPECT_TRUE(ranges_of(scan, fan_of(scan), got)) << one;
  }
}

/// A scan whose ranges are its bearings, plus 10.
struct Turn {
  Turn(std::size_t rays, double first_rad, double step_rad) : ranges(rays) {
    scan.angle_min = static_cast<float>(first_rad);
    scan.angle_increment = static_cast<float>(step_rad);
    scan.angle_max = static_cast<float>(first_rad + step_rad * static_cast<double>(rays - 1));
    scan.range_max = 100;
    for (std::size_t i = 0; i < rays; ++i) {
      ranges[i] = static_cast<float>(10 + first_rad + step_rad * static_cast<double>(i));
    }
    bus::borrow(scan.ranges, ranges);
  }
  std::vector<float> ranges;
  ros2::LaserScan scan{};
};

/// A whole turn in so many rays, from `first_rad` on.
Turn turn_of(std::size_t rays, double first_rad = -kPi) {
  return {rays, first_rad, 2 * kPi / static_cast<double>(rays)};
}

TEST(Ros2Readings, AScanWithAnotherNumberOfRaysIsPutOnTheFirstOnes) {
  for (const std::size_t first : {450U, 457U, 720U, 721U}) {
    const Turn one = turn_of(first);
    const Fan fan = fan_of(one.scan);
    for (const std::size_t rays : {450U, 451U, 455U, 457U, 720U, 721U, 1073U}) {
      for (const double turned : {0.0, 1e-7, 0.003, 1.0, kPi}) {
        const Turn other = turn_of(rays, -kPi + turned);
        std::vector<float> got(first);
        ASSERT_TRUE(ranges_of(other.scan, fan, got));
        for (std::size_t i = 0; i < first; ++i) {
          const double off = wrap_angle(got[i] - 10 - bearings_of(fan)[i]);
          EXPECT_LE(std::abs(off), kPi / static_cast<double>(rays) + 1e-5)
              << rays << " on " << first << ", ray " << i;
        }
      }
    }
  }
}

TEST(Ros2Readings, WhereAScanHasNoRayNearThereIsNoReading) {
  const Turn one(101, -0.5, 0.01);
  const Fan fan = fan_of(one.scan);
  std::vector<float> got(101);
  // It ends earlier, and its rays lie between those of the first.
  const Turn shorter(60, -0.504, 0.01);
  ASSERT_TRUE(ranges_of(shorter.scan, fan, got));
  for (std::size_t i = 0; i < 101; ++i) {
    EXPECT_EQ(std::isnan(got[i]), i >= 60) << i;
  }
  // Rays at four times the spacing: each covers the directions within one spacing.
  const Turn coarse(26, -0.5, 0.04);
  ASSERT_TRUE(ranges_of(coarse.scan, fan, got));
  for (std::size_t i = 0; i < 101; ++i) EXPECT_EQ(std::isnan(got[i]), i % 4 == 2) << i;
}

TEST(Ros2Readings, LimitsThatAScannerChangesAreNoOtherScanner) {
  Turn one(11, -0.5, 0.1);
  const Fan fan = fan_of(one.scan);
  one.scan.range_max = 10.2F;
  one.scan.range_min = 9.7F;
  std::vector<float> got(11);
  ASSERT_TRUE(ranges_of(one.scan, fan, got));
  EXPECT_EQ(got[0], 9.7F);
  EXPECT_EQ(got[5], 10);
  EXPECT_EQ(got[10], kInf);
}

TEST(Ros2Readings, AScannerThatLooksElsewhereIsRefused) {
  std::vector<float> five(5, 1);
  const Fan fan = fan_of(scan_of(five));
  std::vector<float> got(5);
  ros2::LaserScan scan = scan_of(five);
  scan.angle_min = 0.25F;
  EXPECT_EQ(ranges_of(scan, fan, got).error().message,
            "the scanner has changed: 5 rays from 0.2500 rad with spacing 0.25000 rad, instead of "
            "5 from -0.5000 rad with spacing 0.25000 rad; restart the run");
  std::vector<float> one(1, 1);
  scan = scan_of(one);
  const Fan single = fan_of(scan);
  ASSERT_TRUE(ranges_of(scan, single, std::span(got).first(1)));
  EXPECT_EQ(got[0], 1);
  scan.angle_min = 0.1F;
  EXPECT_FALSE(ranges_of(scan, single, std::span(got).first(1)));
}

TEST(Ros2Readings, OdometryBringsItsDoubtOrIsGivenOne) {
  ros2::Odometry message{};
  message.pose.pose = ros2::spatial({1, 2, 0.5}, 0);
  message.twist.twist.linear.x = 0.3;
  message.twist.twist.angular.z = -0.1;
  const Doubt doubt{0.04, 0.01};
  auto reading = odometry_of(message, doubt);
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->x_m, 1);
  EXPECT_NEAR(reading->yaw_rad, 0.5, 1e-15);
  EXPECT_EQ(reading->v_mps, 0.3);
  EXPECT_EQ(reading->w_radps, -0.1);
  EXPECT_EQ(reading->variance_xy_m2, 0.04);
  EXPECT_EQ(reading->variance_yaw_rad2, 0.01);
  message.pose.covariance[0] = 0.1;
  message.pose.covariance[7] = 0.2;
  message.pose.covariance[35] = 0.3;
  reading = odometry_of(message, doubt);
  EXPECT_EQ(reading->variance_xy_m2, 0.2) << "the larger";
  EXPECT_EQ(reading->variance_yaw_rad2, 0.3);
  EXPECT_EQ(pose_of(message, doubt)->variance_xy_m2, 0.2);
  message.pose.pose.orientation = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  EXPECT_FALSE(odometry_of(message, doubt)) << "it lies on its side";
}

TEST(Ros2Readings, WhatIsNotMeasuredIsNoNumber) {
  ros2::Imu imu{};
  imu.orientation_covariance[0] = -1;
  imu.angular_velocity.z = 0.5;
  imu.linear_acceleration.z = 9.81;
  const auto values = imu_values(imu);
  EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[3]));
  EXPECT_EQ(values[6], 0.5);
  EXPECT_EQ(values[9], 9.81);
  ros2::BatteryState battery{};
  battery.percentage = 0.5F;
  battery.voltage = 14;
  battery.temperature = kNan;
  EXPECT_EQ(battery_values(battery)[0], 0.5);
  EXPECT_EQ(battery_values(battery)[1], 14);
  EXPECT_TRUE(std::isnan(battery_values(battery)[5]));
}

}  // namespace
}  // namespace rave::ros2_driver
