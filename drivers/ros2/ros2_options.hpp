// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "dds_network/network_words.hpp"
#include "pose_doubt/pose_doubt.hpp"
#include "rave/line/timing.hpp"
#include "rave/plugin/params.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2_driver {

using pose_doubt::Doubt;
using pose_doubt::read_doubt;

inline constexpr std::array<const char*, 3> kVelocityMessages{"auto", "twist", "twist_stamped"};
inline constexpr std::array<const char*, 2> kCommandMessages{"twist", "twist_stamped"};

inline constexpr std::array<const char*, 3> kNodeForms{"none", "humble", "iron"};

inline constexpr std::array<ParamSpec, 9> kDeviceParams{
    dds_network::domain_param("Domain of the robot: its ROS_DOMAIN_ID."),
    text_param("namespace", "", "Namespace of the robot's topics, such as `/cart`."),
    text_param("interface", "127.0.0.1",
               "Network interface to the robot, by address or name; the default is this machine."),
    text_param("peers", "", "Addresses of the robot, separated by commas."),
    choice_param("multicast", "none", bus::kMulticastNames,
                 "Use of multicast: off, for discovery only, or also for data."),
    choice_param("nodes", "iron", kNodeForms,
                 "Format in which ROS 2 sees this node: Iron (2023) and later, Humble and earlier, "
                 "or none."),
    line::latency_param("Smallest delay from the stamp of a message to its arrival."),
    line::start_timeout_param(
        "Time that the start of a run waits for the first message of each topic."),
    line::lost_after_param(1, "Time after which a silent topic is reported as lost."),
};

/// The parameter `topic` of every sensor, each with its own default.
constexpr ParamSpec topic_param(const char* topic) noexcept {
  return text_param("topic", topic,
                    "Topic to read, in the device's namespace unless it begins with a slash.");
}

inline constexpr const char* kPositionSigmaDoc =
    "Standard deviation of x and y where messages do not have it.";
inline constexpr ParamSpec kPositionSigma = pose_doubt::position_sigma(0.02, kPositionSigmaDoc);
inline constexpr ParamSpec kHeadingSigma = pose_doubt::heading_sigma(
    1, "Standard deviation of the heading where messages do not have it.");

inline constexpr std::array<const char*, 2> kZeroMeanings{"no_reading", "no_return"};
inline constexpr std::array<ParamSpec, 2> kLaserParams{
    topic_param("scan"),
    choice_param(
        "zero", "no_reading", kZeroMeanings,
        "Meaning of a range of exactly 0: not measured, or, for scanners that are known to "
        "write it for that alone, nothing in range."),
};
inline constexpr std::array<ParamSpec, 1> kRangeParams{topic_param("range")};
inline constexpr std::array<ParamSpec, 1> kImuParams{topic_param("imu")};
inline constexpr std::array<ParamSpec, 1> kBatteryParams{topic_param("battery_state")};
inline constexpr std::array<ParamSpec, 2> kCommandParams{
    topic_param("cmd_vel"),
    choice_param("message", "twist", kCommandMessages, "Twist or TwistStamped."),
};
inline constexpr std::array<ParamSpec, 1> kGoalParams{topic_param("goal_pose")};
inline constexpr std::array<ParamSpec, 3> kOdometryParams{topic_param("odom"), kPositionSigma,
                                                          kHeadingSigma};
inline constexpr std::array<ParamSpec, 3> kPoseParams{topic_param("pose"), kPositionSigma,
                                                      kHeadingSigma};
inline constexpr std::array<ParamSpec, 8> kGpsParams{
    topic_param("fix"),
    text_param("imu_topic", "",
               "Topic of an inertial unit with the heading, 0 in the east; empty: the heading "
               "follows from the direction of travel."),
    numbers_param("geo_origin", "", -360, 1e5,
                  "Origin of the world: latitude, longitude (deg), altitude (m), yaw of x from "
                  "east (deg); empty: that of the scenario."),
    pose_doubt::position_sigma(2.5, kPositionSigmaDoc, 1000),
    kHeadingSigma,
    number_param("course_distance_m", "m", 0.5, 0.01, 1000,
                 "Without `imu_topic`: smallest distance between two fixes that gives a heading."),
    number_param("antenna_x_m", "m", 0, -100, 100, "Position of the antenna on the body, forward."),
    number_param("antenna_y_m", "m", 0, -100, 100,
                 "Position of the antenna on the body, to the left."),
};
inline constexpr std::array<ParamSpec, 6> kTfPoseParams{
    text_param("topic", "/tf", "Topic of the transforms that change."),
    text_param("static_topic", "/tf_static", "Topic of those that never change."),
    text_param("map_frame", "map", "Frame that the pose is in."),
    text_param("base_frame", "base_link", "Frame of the robot's body."),
    kPositionSigma,
    kHeadingSigma,
};
inline constexpr std::array<ParamSpec, 8> kVelocityParams{
    text_param("topic", "cmd_vel",
               "Topic to write, in the device's namespace unless it begins with a slash."),
    choice_param("message", "auto", kVelocityMessages,
                 "Twist or TwistStamped; `auto`: whichever the robot reads."),
    number_param("watchdog_s", "s", 0.25, 0.02, 10,
                 "Time without a command after which the robot is stopped."),
    number_param("device_watchdog_s", "s", 0, 0, 60,
                 "Timeout after which the robot stops by itself, according to its manufacturer "
                 "(`cmd_vel_timeout`); 0: none."),
    number_param("refresh_s", "s", 0.05, 0.01, 1, "Time between repetitions of the command."),
    integer_param(
        "most_readers", 1, 1, 100,
        "Number of readers of the topic up to which the robot is driven. A second one may "
        "be a second robot; allow recorders and monitors here."),
    number_param("max_v_mps", "m/s", 1, 0.01, 50, "Largest speed, forward and backward."),
    number_param("max_w_radps", "rad/s", 3, 0.01, 50, "Largest turning rate."),
};

/// The parameters of the device, read and checked.
struct DeviceOptions {
  ros2::Network network;
  std::string name_space;
  line::Timing timing;
};

/// Errors: those of ros2::whole_name() for the namespace.
[[nodiscard]] Result<DeviceOptions> read_options(const Params& params, const char* robot);

}  // namespace rave::ros2_driver
