// SPDX-License-Identifier: Apache-2.0
#include "udp_pose/pose_datagram.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace rave::udp_pose {
namespace {

std::string error_of(const std::string& text) {
  const auto parsed = parse_datagram(text);
  return parsed ? "none" : parsed.error().text();
}

TEST(Datagram, Whole) {
  const auto pose = parse_datagram(
      R"({"body": "cart", "t": 12.5, "x": 1, "y": -2.5e0, "yaw": 4, "cov": [1e-6, 2e-6, 3e-4],
          "seq": 7})");
  ASSERT_TRUE(pose) << pose.error().text();
  EXPECT_EQ(pose->body, "cart");
  EXPECT_EQ(pose->t_s, 12.5);
  EXPECT_EQ(pose->x_m, 1);
  EXPECT_EQ(pose->y_m, -2.5);
  EXPECT_NEAR(pose->yaw_rad, 4 - 2 * std::numbers::pi, 1e-15);
  ASSERT_TRUE(pose->variance);
  EXPECT_EQ(pose->variance->y_m2, 2e-6);
  EXPECT_EQ(pose->variance->yaw_rad2, 3e-4);
  EXPECT_EQ(pose->seq, 7);
}

TEST(Datagram, WithoutWhatIsOptional) {
  const auto pose = parse_datagram(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0})");
  ASSERT_TRUE(pose) << pose.error().text();
  EXPECT_FALSE(pose->variance);
  EXPECT_FALSE(pose->seq);
}

TEST(Datagram, SaysWhatIsWrong) {
  EXPECT_EQ(error_of(""), "not JSON");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0} x)"), "not JSON");
  EXPECT_EQ(error_of(R"({"body":"a","t":NaN,"x":0,"y":0,"yaw":0})"), "not JSON");
  EXPECT_EQ(error_of(R"({"body":"a","t":1e999,"x":0,"y":0,"yaw":0})"), "not JSON");
  EXPECT_EQ(error_of("[]"), "not a JSON object");
  EXPECT_EQ(error_of(R"({"t":0,"x":0,"y":0,"yaw":0})"), "`body` is missing");
  EXPECT_EQ(error_of(R"({"body":7,"t":0,"x":0,"y":0,"yaw":0})"), "`body` is not a string");
  EXPECT_EQ(error_of(R"({"body":"","t":0,"x":0,"y":0,"yaw":0})"), "`body` must have 1 to 64 bytes");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"yaw":0})"), "`y` is missing");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":"0","y":0,"yaw":0})"), "`x` is not a number");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":2e6,"y":0,"yaw":0})"), "`x` is beyond 1000000");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0,"z":0})"),
            "unknown key; expected body, t, x, y, yaw, cov and seq");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"x":1,"y":0,"yaw":0})"), "duplicate key `x`");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0,"cov":[1,2]})"),
            "`cov` is not a list of three numbers");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0,"cov":[1,2,-3]})"),
            "`cov` is negative");
  EXPECT_EQ(error_of(R"({"body":"a","t":0,"x":0,"y":0,"yaw":0,"seq":1.5})"),
            "`seq` is not a whole number from 0");
  EXPECT_EQ(error_of(std::string(2049, ' ')), "longer than 2048 bytes");
}

}  // namespace
}  // namespace rave::udp_pose
