// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/validate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "rave/bus/sequence.hpp"

namespace rave::ros2 {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::string why(const Status& status) { return status ? "" : status.error().message; }

struct Scan {
  std::vector<float> ranges{1, 2, kInf, static_cast<float>(kNan), 0};
  std::vector<float> intensities;
  LaserScan message{};

  Scan() {
    message.angle_min = -1;
    message.angle_max = 1;
    message.angle_increment = 0.5F;
    message.range_min = 0.05F;
    message.range_max = 8;
  }
  std::string judge() {
    bus::borrow(message.ranges, ranges);
    bus::borrow(message.intensities, intensities);
    return why(validate(message));
  }
};

TEST(Ros2Validate, AScanMayHaveRangesThatAreNone) {
  EXPECT_EQ(Scan().judge(), "");
  Scan off_by_one;
  off_by_one.ranges.push_back(1);
  EXPECT_EQ(off_by_one.judge(), "") << "drivers disagree on where the last ray goes";
}

TEST(Ros2Validate, ScansThatNobodyCanUse) {
  Scan scan;
  scan.message.angle_min = static_cast<float>(kNan);
  EXPECT_EQ(scan.judge(), "angle_min is nan, not within +-100");
  scan = {};
  scan.ranges.resize(100, 1);
  EXPECT_EQ(scan.judge(), "ranges has 100 entries where its angles make 5");
  scan = {};
  scan.ranges.clear();
  EXPECT_EQ(scan.judge(), "ranges has 0 entries, not 1 to 100000");
  scan = {};
  scan.ranges.resize(kMostBeams + 1);
  EXPECT_EQ(scan.judge(), "ranges has 100001 entries, not 1 to 100000");
  scan = {};
  scan.intensities.resize(2);
  EXPECT_EQ(scan.judge(), "intensities has 2 entries for 5 ranges");
  scan = {};
  scan.message.angle_increment = 0;
  EXPECT_EQ(scan.judge(), "angle_increment is 0");
  scan = {};
  scan.message.range_min = 9;
  EXPECT_EQ(scan.judge(), "ranges from 9 m to 8 m");
  scan = {};
  scan.message.header.stamp.nanosec = 2'000'000'000;
  EXPECT_EQ(scan.judge(), "header.stamp has 2000000000 ns, a second or more");
  scan = {};
  std::string frame = "laser\x1b[2J";
  scan.message.header.frame_id = frame.data();
  EXPECT_EQ(scan.judge(), "header.frame_id has control characters");
}

TEST(Ros2Validate, PosesAndTwists) {
  Odometry odometry{};
  EXPECT_EQ(why(validate(odometry)), "pose.orientation has the length 0; a rotation has 1");
  odometry.pose.pose.orientation.w = 1;
  EXPECT_EQ(why(validate(odometry)), "");
  odometry.pose.pose.position.y = kNan;
  EXPECT_EQ(why(validate(odometry)), "pose.position is nan, not within +-10000000");
  odometry.pose.pose.position.y = 0;
  odometry.pose.covariance[7] = kNan;
  EXPECT_EQ(why(validate(odometry)), "pose.covariance is nan, not within +-100000000000000");
  Twist twist{};
  twist.linear.x = 1e5;
  EXPECT_EQ(why(validate(twist)), "twist.linear is 100000, not within +-10000");
  TwistStamped stamped{};
  stamped.twist.angular.z = kNan;
  EXPECT_NE(why(validate(stamped)), "");
}

TEST(Ros2Validate, WhatAnImuDoesNotMeasureMayBeAnything) {
  Imu imu{};
  EXPECT_EQ(why(validate(imu)), "orientation has the length 0; a rotation has 1");
  imu.orientation_covariance[0] = -1;
  EXPECT_EQ(why(validate(imu)), "");
  imu.angular_velocity.z = kNan;
  EXPECT_EQ(why(validate(imu)), "angular_velocity is nan, not within +-10000");
  imu.angular_velocity_covariance[0] = -1;
  EXPECT_EQ(why(validate(imu)), "");
}

TEST(Ros2Validate, OtherMessages) {
  Range range{};
  range.max_range = 4;
  range.range = kInf;
  EXPECT_EQ(why(validate(range)), "");
  range.range = static_cast<float>(kNan);
  EXPECT_EQ(why(validate(range)), "range is nan");
  NavSatFix fix{};
  fix.latitude = 91;
  EXPECT_EQ(why(validate(fix)), "latitude is 91, not within +-90");
  fix.status.status = -1;
  EXPECT_EQ(why(validate(fix)), "") << "without a fix it says nothing";
  BatteryState battery{};
  battery.voltage = kInf;
  EXPECT_EQ(why(validate(battery)), "an infinite value of a battery");
  battery.voltage = static_cast<float>(kNan);
  EXPECT_EQ(why(validate(battery)), "");
  std::vector<TransformStamped> transforms(2);
  TfMessage tf{};
  bus::borrow(tf.transforms, transforms);
  EXPECT_EQ(why(validate(tf)), "transform.rotation has the length 0; a rotation has 1");
  for (TransformStamped& each : transforms) each.transform.rotation.w = 1;
  EXPECT_EQ(why(validate(tf)), "");
  std::string text(kLongestText + 1, 'a');
  String string{text.data()};
  EXPECT_EQ(why(validate(string)), "data has 1000001 bytes, more than 1000000");
}

}  // namespace
}  // namespace rave::ros2
