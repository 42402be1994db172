// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2_bridge/ros2_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/bus/sequence.hpp"
#include "rave/math/scalar.hpp"
#include "rave/ros2/validate.hpp"

namespace rave::runtime {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A sample of one sensor as the engine shows it.
template <class Record>
struct Sample {
  SensorInfo info;
  std::vector<Record> records;
  SampleHeader header;

  sim::SensorSample view() {
    header.count = static_cast<std::uint32_t>(records.size());
    header.stamp_ns = 2'500'000'000;
    return {&info, &header, records.data(), {}};
  }
};

TEST(Ros2Messages, KindsFollowFromTheReadings) {
  SensorInfo info;
  info.kind = ReadingKind::kRanges;
  info.capacity = 3;
  const std::vector<double> even{-0.5, 0, 0.5};
  const std::vector<double> uneven{-0.5, 0, 1};
  info.bearings_rad = even.data();
  EXPECT_EQ(ros2_kind(info, "virtual_laser"), Ros2Kind::kScan);
  info.bearings_rad = uneven.data();
  EXPECT_EQ(ros2_kind(info, "virtual_infrared"), Ros2Kind::kNone);
  info.capacity = 1;
  info.cone_rad = 0.3;
  EXPECT_EQ(ros2_kind(info, "virtual_sonar"), Ros2Kind::kRange);
  info.kind = ReadingKind::kValues;
  info.capacity = 6;
  EXPECT_EQ(ros2_kind(info, "create_battery"), Ros2Kind::kBattery);
  EXPECT_EQ(ros2_kind(info, "create_cliff"), Ros2Kind::kNone);
  info.capacity = 10;
  EXPECT_EQ(ros2_kind(info, "ros2_imu"), Ros2Kind::kImu);
  info.kind = ReadingKind::kPose;
  EXPECT_EQ(ros2_kind(info, "indoor_positioning"), Ros2Kind::kFix);
  EXPECT_EQ(ros2_kind(info, "ros2_goal"), Ros2Kind::kNone) << "where the robot is not";
  info.kind = ReadingKind::kContact;
  EXPECT_EQ(ros2_kind(info, "virtual_contact"), Ros2Kind::kNone);
}

TEST(Ros2Messages, AScanStandsForItself) {
  const std::vector<double> bearings{-0.5, 0, 0.5};
  Sample<float> sample;
  sample.info.capacity = 3;
  sample.info.bearings_rad = bearings.data();
  sample.info.range_min_m = 0.1;
  sample.info.range_max_m = 8;
  sample.records = {1, 2, std::numeric_limits<float>::infinity()};
  Ros2Reading reading("cart/laser", "");
  const ros2::LaserScan scan = reading.scan(sample.view());
  EXPECT_TRUE(ros2::validate(scan));
  EXPECT_STREQ(scan.header.frame_id, "cart/laser");
  EXPECT_EQ(scan.header.stamp.sec, 2);
  EXPECT_EQ(scan.header.stamp.nanosec, 500'000'000U);
  EXPECT_EQ(scan.angle_min, -0.5F);
  EXPECT_EQ(scan.angle_increment, 0.5F);
  EXPECT_EQ(bus::elements(scan.ranges)[1], 2);
}

TEST(Ros2Messages, WhatAnImuDoesNotMeasureIsMarked) {
  Sample<double> sample;
  sample.records = {kNan, kNan, kNan, kNan, 0, 0, 0.5, kNan, kNan, kNan};
  Ros2Reading reading("imu", "");
  const ros2::Imu imu = reading.imu(sample.view());
  EXPECT_EQ(imu.orientation_covariance[0], -1);
  EXPECT_EQ(imu.angular_velocity.z, 0.5);
  EXPECT_EQ(imu.linear_acceleration_covariance[0], -1);
  EXPECT_TRUE(ros2::validate(imu));
}

TEST(Ros2Messages, ABatteryAndOdometry) {
  Sample<double> sample;
  sample.records = {0.5, 14.4, -1, 1.5, 3, 25};
  Ros2Reading reading("odom", "base_link");
  const ros2::BatteryState battery = reading.battery(sample.view());
  EXPECT_EQ(battery.percentage, 0.5F);
  EXPECT_EQ(battery.temperature, 25);
  EXPECT_TRUE(ros2::validate(battery));
  const ros2::Odometry odometry =
      reading.odometry({1, 2, kPi / 2, 0.3, 0.1, 0.01, 0.02}, {1'000'000'000});
  EXPECT_TRUE(ros2::validate(odometry));
  EXPECT_STREQ(odometry.child_frame_id, "base_link");
  EXPECT_NEAR(odometry.pose.pose.orientation.z, std::sqrt(0.5), 1e-12);
  EXPECT_EQ(odometry.pose.covariance[7], 0.01);
  EXPECT_EQ(odometry.pose.covariance[35], 0.02);
}

TEST(Ros2Messages, APoseIsAFixWhereTheWorldLies) {
  const GeoFrame earth({47.3769, 8.5417, 408}, kPi / 2);
  Sample<PoseReading> sample;
  sample.records = {{2, 0, 1, 0.04, 0.1}};
  Ros2Reading reading("cart/base_link", "");
  // 2 m along an axis that stands at (10, 5) and looks along y, in a world whose x is north.
  const ros2::NavSatFix fix = reading.fix(sample.view(), earth, {10, 5, kPi / 2});
  EXPECT_TRUE(ros2::validate(fix));
  const Point3 there = earth.world_point({fix.latitude, fix.longitude, fix.altitude});
  EXPECT_NEAR(there.x, 10, 1e-6);
  EXPECT_NEAR(there.y, 7, 1e-6);
  EXPECT_GT(fix.latitude, 47.3769);
  EXPECT_LT(fix.longitude, 8.5417);
  EXPECT_EQ(fix.position_covariance[4], 0.04);
  EXPECT_EQ(fix.status.status, 0);
  sample.records.clear();
  const ros2::NavSatFix none = reading.fix(sample.view(), earth, {});
  EXPECT_EQ(none.status.status, -1);
  EXPECT_TRUE(std::isnan(none.latitude));
  EXPECT_TRUE(ros2::validate(none));
}

TEST(Ros2Messages, TheDescriptionHasBodyAndSensors) {
  world::Body body;
  body.shapes.push_back(*world::make_disc({0.1, 0}, 0.2, 0, 0.4));
  const std::vector<Vec2> box{{-0.1, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.1, 0.2}};
  const auto prisms = world::make_prisms(box, 0.4, 0.6);
  ASSERT_TRUE(prisms);
  body.shapes.push_back(prisms->front());
  sim::RobotType type;
  type.sensors.resize(1);
  type.sensors[0].name = "front laser";
  type.sensors[0].X_RS = {0.25, 0, 0.5};
  type.sensors[0].z_m = 0.15;
  const std::string urdf = urdf_of(body, type, "cart", "cart/");
  for (const char* const part :
       {"<robot name=\"cart\">", "<link name=\"cart/base_link\">",
        "<visual><origin xyz=\"0.1 0 0.2\"/><geometry><cylinder radius=\"0.2\" length=\"0.4\"/>",
        "<box size=\"0.4 0.4 0.", "<link name=\"cart/front_laser\"/>",
        "<parent link=\"cart/base_link\"/>", "<origin xyz=\"0.25 0 0.15\" rpy=\"0 0 0.5\"/>"}) {
    EXPECT_NE(urdf.find(part), std::string::npos) << part << " in\n" << urdf;
  }
}

}  // namespace
}  // namespace rave::runtime
