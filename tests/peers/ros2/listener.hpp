// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "ros2/graph.hpp"
#include "ros2/node.hpp"
#include "ros2_messages.h"

namespace peer {

/// Nodes of ROS 2 that look at a robot and send it commands, as rviz and a joystick do. Messages
/// come on threads of Fast DDS; the rest is of one thread.
class Ros2Listener {
 public:
  /// Options: domain, namespace, stamped, gid-bytes.
  explicit Ros2Listener(const Arguments& given);

  /// Sends a velocity; a goal.
  void drive(double v_mps, double w_radps);
  void go_to(double x, double y);
  /// One JSON object: how many messages of each kind came, how many of them were bad, and what the
  /// newest said; and what the graph has.
  [[nodiscard]] std::string state();

 private:
  struct Kind {
    std::int64_t count = 0;
    std::int64_t bad = 0;
    std::int64_t newest_ns = -1;  ///< Its stamp.
    std::string said;             ///< JSON of the newest.
    std::set<std::string> from;   ///< The writers.
  };

  template <class Message, class PubSub>
  void listen(const std::string& topic, const std::string& kind, const Delivery& delivery);
  void listen_to_nodes(double gid_bytes);
  void note(const std::string& kind, std::int64_t stamp_ns, bool good, std::string said);

  // What each kind of message is looked at for: stamp, whether it is good, and what it says.
  void hear(const std::string& kind, const nav_msgs::msg::dds_::Odometry_& message);
  void hear(const std::string& kind, const sensor_msgs::msg::dds_::LaserScan_& message);
  void hear(const std::string& kind, const sensor_msgs::msg::dds_::Range_& message);
  void hear(const std::string& kind, const sensor_msgs::msg::dds_::BatteryState_& message);
  void hear(const std::string& kind, const sensor_msgs::msg::dds_::NavSatFix_& message);
  void hear(const std::string& kind, const tf2_msgs::msg::dds_::TFMessage_& message);
  void hear(const std::string& kind, const rosgraph_msgs::msg::dds_::Clock_& message);
  void hear(const std::string& kind, const std_msgs::msg::dds_::String_& message);

  std::mutex mutex_;  // guards kinds_
  std::map<std::string, Kind> kinds_;
  std::vector<std::unique_ptr<eprosima::fastdds::dds::DataReaderListener>> ears_;
  Graph graph_;
  Node node_;
  bool stamped_;
  eprosima::fastdds::dds::DataWriter* drive_;
  eprosima::fastdds::dds::DataWriter* goal_;
};

}  // namespace peer
