// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "rave/math/geodesy.hpp"
#include "rave/ros2/convert.hpp"
#include "rave/sim/engine.hpp"

/// Converts data of the engine to messages of ROS 2. Texts and arrays stay in the object that made
/// the message: publish it before the object is used again. Otherwise pure; one thread at a time.
namespace rave::runtime {

/// The message type for the readings of a sensor.
enum class Ros2Kind : std::uint8_t { kNone, kScan, kRange, kOdometry, kImu, kBattery, kFix };
[[nodiscard]] Ros2Kind ros2_kind(const SensorInfo& info, std::string_view driver) noexcept;
/// The usual name of its topic; empty for kNone.
[[nodiscard]] std::string_view ros2_topic(Ros2Kind kind) noexcept;

/// The messages of one sensor of one robot.
class Ros2Reading {
 public:
  /// `frame`: frame of the sensor. For odometry: `frame` of the pose, and `child` of the body.
  Ros2Reading(std::string frame, std::string child)
      : frame_(std::move(frame)), child_(std::move(child)) {}

  [[nodiscard]] ros2::LaserScan scan(const sim::SensorSample& sample);
  [[nodiscard]] ros2::Range range(const sim::SensorSample& sample);
  [[nodiscard]] ros2::Odometry odometry(const OdometryReading& reading, SimTime stamp);
  [[nodiscard]] ros2::Imu imu(const sim::SensorSample& sample);
  [[nodiscard]] ros2::BatteryState battery(const sim::SensorSample& sample);
  /// From a pose in frame M, which is at X_WM in the world. A sample without a pose gives a message
  /// without a fix.
  [[nodiscard]] ros2::NavSatFix fix(const sim::SensorSample& sample, const GeoFrame& earth,
                                    const Pose2& X_WM);

 private:
  [[nodiscard]] ros2::Header header(SimTime stamp);

  std::string frame_;
  std::string child_;
  std::vector<float> ranges_m_;
};

/// The URDF of a robot: its body as boxes and cylinders, and a link for each sensor at its mount.
/// `prefix` precedes the names of links.
[[nodiscard]] std::string urdf_of(const world::Body& body, const sim::RobotType& type,
                                  std::string_view robot, std::string_view prefix);

}  // namespace rave::runtime
