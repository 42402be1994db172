// SPDX-License-Identifier: Apache-2.0
#include "rave/ros2/names.hpp"

#include <gtest/gtest.h>

namespace rave::ros2 {
namespace {

TEST(Ros2Names, TopicsStandInTheirNamespace) {
  EXPECT_EQ(*whole_name("/cart", "scan"), "/cart/scan");
  EXPECT_EQ(*whole_name("cart/", "front/scan"), "/cart/front/scan");
  EXPECT_EQ(*whole_name("", "scan"), "/scan");
  EXPECT_EQ(*whole_name("/cart", "/tf"), "/tf");
}

TEST(Ros2Names, WrongOnesAreNamed) {
  EXPECT_EQ(
      whole_name("", "2d/scan").error().message,
      "`/2d/scan` is not a valid topic name: `2d` must be letters, digits and underscores, no "
      "digit first, as in `/cart/scan`");
  for (const char* const wrong : {"", "/", "a//b", "a/", "a b", "a-b", "~/scan", "a\nb"}) {
    EXPECT_FALSE(whole_name("", wrong)) << wrong;
  }
  EXPECT_FALSE(whole_name("cart-1", "scan"));
  EXPECT_NE(whole_name("", std::string(300, 'a')).error().message.find("longer than 200"),
            std::string::npos);
}

TEST(Ros2Names, AnyTextMakesAWord) {
  EXPECT_EQ(word_of("cart-1.left"), "cart_1_left");
  EXPECT_EQ(word_of("2nd"), "_2nd");
  EXPECT_EQ(word_of(""), "_");
}

TEST(Ros2Names, OnTheWireAndBack) {
  EXPECT_EQ(wire_topic("/cart/scan"), "rt/cart/scan");
  EXPECT_EQ(topic_of_wire("rt/cart/scan"), "/cart/scan");
  EXPECT_EQ(topic_of_wire("rave/world"), "rave/world");
  EXPECT_EQ(type_of_wire("sensor_msgs::msg::dds_::LaserScan_"), "sensor_msgs/msg/LaserScan");
  EXPECT_EQ(type_of_wire("rave::wire::World"), "rave::wire::World");
}

}  // namespace
}  // namespace rave::ros2
