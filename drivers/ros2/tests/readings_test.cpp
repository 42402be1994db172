// SPDX-License-Identifier: Apache-2.0
#include "ros2/readings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/bus/sequence.hpp"
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
  std::vector<float> sent{kInf, 0, -kInf, 0.1F, 2};
  const ros2::LaserScan scan = scan_of(sent);
  const Fan fan = fan_of(scan);
  EXPECT_EQ(bearings_of(fan), (std::vector<double>{-0.5, -0.25, 0, 0.25, 0.5}));
  std::vector<float> got(5);
  ASSERT_TRUE(ranges_of(scan, fan, got));
  EXPECT_EQ(got, (std::vector<float>{kInf, kInf, 0.25F, 0.25F, 2}));
  EXPECT_EQ(range_of(8.5F, 0.25, 8), kInf) << "beyond what it can measure";
  EXPECT_EQ(range_of(0, 0, 8), 0) << "it can measure that";
  for (const float bad : {kNan, -0.1F, -1.0F, -1e30F}) {
    EXPECT_TRUE(std::isnan(range_of(bad, 0.25, 8))) << bad << " is not free space";
    EXPECT_TRUE(std::isnan(range_of(bad, 0, 8))) << bad;
  }
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

TEST(Ros2Readings, AnotherScannerIsRefused) {
  std::vector<float> five(5, 1);
  const Fan fan = fan_of(scan_of(five));
  std::vector<float> nine(9, 1);
  ros2::LaserScan scan = scan_of(nine);
  scan.angle_increment = 0.125F;
  std::vector<float> got(5);
  EXPECT_EQ(ranges_of(scan, fan, got).error().message,
            "the scanner has changed: 9 rays from -0.5000 rad with spacing 0.12500 rad, instead of "
            "5 from -0.5000 rad with spacing 0.25000 rad; restart the run");
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
