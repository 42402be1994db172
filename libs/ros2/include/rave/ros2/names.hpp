// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

/// Names of topics and types, as people write them in ROS 2 (`/cart/scan`, `sensor_msgs/msg/Range`)
/// and as they are on the wire (`rt/cart/scan`, `sensor_msgs::msg::dds_::Range_`). Source: the
/// design article "Topic and Service name mapping to DDS" (design.ros2.org). Pure; any thread.
namespace rave::ros2 {

/// The whole name of a topic: one that begins with `/` is whole, another stands in the namespace
/// (`/cart`, `cart`, or empty). Error kInvalidArgument: a part that is no word of letters, digits
/// and underscores which begins with no digit.
[[nodiscard]] Result<std::string> whole_name(std::string_view name_space, std::string_view topic);

/// A word for a name, made of any text: what cannot be in it becomes an underscore.
[[nodiscard]] std::string word_of(std::string_view text);

/// `/cart/scan` on the wire.
[[nodiscard]] std::string wire_topic(std::string_view whole_name);
/// The reverse; what is no topic of ROS 2 stays as it is.
[[nodiscard]] std::string topic_of_wire(std::string_view wire);
[[nodiscard]] std::string type_of_wire(std::string_view wire);

}  // namespace rave::ros2
