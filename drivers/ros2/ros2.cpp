// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/plugin_entry.hpp"
#include "ros2/ros2_commands.hpp"
#include "ros2/ros2_gps.hpp"
#include "ros2/ros2_sensors.hpp"
#include "ros2/ros2_velocity.hpp"

namespace rave::ros2_driver {
namespace {

Description describe(const char* name, const char* summary, std::span<const ParamSpec> params) {
  return {.name = name,
          .summary = summary,
          .params = params,
          .clock = DriverClock::kLive,
          .device = "ros2"};
}

/// Description of sensors for commands of others, which may never come.
Description describe_input(const char* name, const char* summary,
                           std::span<const ParamSpec> params) {
  Description description = describe(name, summary, params);
  description.timing = SampleTiming::kEvents;
  return description;
}

}  // namespace
}  // namespace rave::ros2_driver

RAVE_PLUGIN(
    "ros2 ros2_laser ros2_range ros2_odometry ros2_pose ros2_tf_pose ros2_odometry_pose ros2_gps "
    "ros2_imu ros2_battery ros2_command ros2_goal ros2_velocity") {
  using namespace rave::ros2_driver;
  rave::Description device =
      describe("ros2", "A robot that speaks ROS 2, on a network of DDS.", kDeviceParams);
  device.device = "";
  rave::add_device<Ros2Device>(registry, device);
  rave::add_sensor<Ros2Laser>(
      registry,
      describe("ros2_laser", "The scans of a robot (sensor_msgs/LaserScan).", kLaserParams));
  rave::add_sensor<Ros2Range>(
      registry, describe("ros2_range", "A sonar or infrared sensor of a robot (sensor_msgs/Range).",
                         kRangeParams));
  rave::add_sensor<Ros2Odometry>(
      registry,
      describe("ros2_odometry", "The odometry of a robot (nav_msgs/Odometry).", kOdometryParams));
  rave::add_sensor<Ros2Pose>(
      registry,
      describe(
          "ros2_pose",
          "The pose of a robot from motion capture or localisation (geometry_msgs/PoseStamped).",
          kPoseParams));
  rave::add_sensor<Ros2TfPose>(
      registry,
      describe("ros2_tf_pose",
               "The pose of a robot from its transforms (tf2_msgs/TFMessage), map to base.",
               kTfPoseParams));
  rave::add_sensor<Ros2OdometryPose>(
      registry,
      describe("ros2_odometry_pose", "The pose of a robot from its odometry (nav_msgs/Odometry).",
               kOdometryParams));
  rave::add_sensor<Ros2Gps>(
      registry,
      describe("ros2_gps", "The pose of a robot from satellite navigation (sensor_msgs/NavSatFix).",
               kGpsParams));
  rave::add_sensor<Ros2Imu>(
      registry,
      describe("ros2_imu",
               "Orientation, turning rates and accelerations of a robot (sensor_msgs/Imu).",
               kImuParams));
  rave::add_sensor<Ros2Battery>(
      registry, describe("ros2_battery", "The battery of a robot (sensor_msgs/BatteryState).",
                         kBatteryParams));
  rave::add_sensor<Ros2Command>(
      registry,
      describe_input("ros2_command",
                     "Velocity commands from ROS 2 (geometry_msgs/Twist or TwistStamped).",
                     kCommandParams));
  rave::add_sensor<Ros2Goal>(
      registry,
      describe_input("ros2_goal", "Goals from ROS 2 (geometry_msgs/PoseStamped).", kGoalParams));
  rave::add_actuator<Ros2Velocity>(
      registry,
      describe("ros2_velocity", "Drives a robot by velocity (geometry_msgs/Twist or TwistStamped).",
               kVelocityParams));
}
