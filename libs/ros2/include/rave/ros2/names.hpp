// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

/// Names of topics and types as people write them in ROS 2 (`/cart/scan`, `sensor_msgs/msg/Range`)
/// and on the wire (`rt/cart/scan`, `sensor_msgs::msg::dds_::Range_`). Source: the design article
/// "Topic and Service name mapping to DDS" (design.ros2.org). Pure; any thread.
namespace rave::ros2 {

/// The absolute name of a topic. A name that begins with `/` is absolute; others are relative to
/// the namespace (`/cart`, `cart`, or empty). Error kInvalidArgument: each part must consist of
/// letters, digits and underscores and not begin with a digit.
[[nodiscard]] Result<std::string> whole_name(std::string_view name_space, std::string_view topic);

/// A valid part of a name, made from any text: other characters become underscores.
[[nodiscard]] std::string word_of(std::string_view text);

/// The wire name of a topic with an absolute name.
[[nodiscard]] std::string wire_topic(std::string_view whole_name);
/// The inverse of wire_topic(); names that are not topics of ROS 2 are returned unchanged.
[[nodiscard]] std::string topic_of_wire(std::string_view wire);
[[nodiscard]] std::string type_of_wire(std::string_view wire);

}  // namespace rave::ros2
