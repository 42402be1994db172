// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "plant.hpp"
#include "ros2/node.hpp"
#include "ros2_messages.h"

namespace peer {

/// A small robot with two wheels and a laser as its nodes of ROS 2 show it: it obeys cmd_vel and
/// writes odom, scan, range, imu, fix, battery_state, pose (a motion capture), tf and tf_static.
/// One thread, but commands come on those of Fast DDS.
class Ros2Robot {
 public:
  /// What its laser does.
  enum class Laser { kWorks, kSilent, kNegative };
  /// What its odometry does: the message and the transform.
  enum class Wheels { kWork, kSilent, kNan };

  explicit Ros2Robot(const Arguments& given);

  /// Moves on to now and writes what is due; returns when it wants to be called again (CLOCK
  /// _MONOTONIC, ns).
  std::int64_t attend();
  /// From now on what it writes follows a rule instead of physics: see README.md.
  void set_pattern(bool pattern) { pattern_ = pattern; }
  void set_mute(bool mute) { mute_ = mute; }
  /// Silent: it writes no more scans, while all else goes on. Negative: each range is -1.
  void set_laser(Laser laser) { laser_ = laser; }
  /// Silent: it writes no odometry, while all else goes on, the localisation included.
  void set_wheels(Wheels wheels) { wheels_ = wheels; }
  /// Whether its satellite navigation knows where it is.
  void set_fix(bool fix) { has_fix_ = fix; }
  /// Writes messages that nobody can use, `count` of each kind.
  void write_garbage(int count);
  /// One JSON object.
  [[nodiscard]] std::string state();

 private:
  struct Order {
    double v_mps = 0;
    double w_radps = 0;
    std::int64_t at_ns = 0;
    std::int64_t count = 0;
    std::int64_t bad = 0;
  };
  /// A topic with its own rate.
  struct Task {
    std::int64_t period_ns = 0;
    std::int64_t due_ns = 0;
    void (Ros2Robot::*write)(std::int64_t stamp_ns) = nullptr;
  };

  void hear(double v_mps, double w_radps);
  void move(std::int64_t now_ns);
  void write_odometry(std::int64_t stamp_ns);
  void write_scan(std::int64_t stamp_ns);
  void write_range(std::int64_t stamp_ns);
  void write_imu(std::int64_t stamp_ns);
  void write_battery(std::int64_t stamp_ns);
  void write_fix(std::int64_t stamp_ns);
  void write_pose(std::int64_t stamp_ns);
  void write_map(std::int64_t stamp_ns);
  void write_static(std::int64_t stamp_ns);
  [[nodiscard]] sensor_msgs::msg::dds_::LaserScan_ scan(std::int64_t stamp_ns) const;

  Plant plant_;
  std::array<double, 3> start_{};  ///< Where its odometry began, in the map.
  std::mt19937_64 random_;
  std::int64_t watchdog_ns_;
  std::vector<double> rays_;  ///< Numbers of rays of its scans, one after the other.
  std::size_t scans_ = 0;
  bool mute_ = false;
  Laser laser_ = Laser::kWorks;
  Wheels wheels_ = Wheels::kWork;
  bool pattern_ = false;
  bool has_fix_ = true;
  std::array<double, 3> origin_{};  ///< Latitude, longitude, altitude of the room's origin.
  std::int64_t moved_ns_;
  std::int64_t watchdog_stops_ = 0;
  bool moving_ = false;
  double farthest_x_ = -1e9;
  std::int64_t written_ = 0;  ///< Messages of all topics.

  std::mutex mutex_;  // guards order_
  Order order_;

  Ear<geometry_msgs::msg::dds_::Twist_> plain_ear_;
  Ear<geometry_msgs::msg::dds_::TwistStamped_> stamped_ear_;
  Node node_;
  eprosima::fastdds::dds::DataWriter* odometry_;
  eprosima::fastdds::dds::DataWriter* scan_;
  eprosima::fastdds::dds::DataWriter* range_;
  eprosima::fastdds::dds::DataWriter* imu_;
  eprosima::fastdds::dds::DataWriter* battery_;
  eprosima::fastdds::dds::DataWriter* fix_;
  eprosima::fastdds::dds::DataWriter* pose_;
  eprosima::fastdds::dds::DataWriter* tf_;
  eprosima::fastdds::dds::DataWriter* tf_static_;
  std::array<Task, 8> tasks_;
};

}  // namespace peer
