// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "describe.hpp"
#include "setup_copy.hpp"
#include "support.hpp"

namespace rave::isolation {
namespace {

TEST(SetupCopy, GivesBackWhatWasEncoded) {
  TestRobot robot;
  const std::string bytes = encode_setup({"a.so", "wander", 12}, robot.setup());
  const auto copy = SetupCopy::decode(bytes);
  ASSERT_TRUE(copy) << copy.error().text();
  EXPECT_EQ((*copy)->order().plugin, "a.so");
  EXPECT_EQ((*copy)->order().parent, 12);
  // Everything that is encoded again is equal, and that is everything.
  EXPECT_EQ(encode_setup((*copy)->order(), (*copy)->setup()), bytes);
  EXPECT_EQ((*copy)->setup().sensors[0].bearings_rad[3], 0.3);
  EXPECT_EQ((*copy)->setup().sensors[1].bearings_rad, nullptr);
  EXPECT_EQ((*copy)->setup().params[2].list[1], 0.5);
  EXPECT_EQ((*copy)->setup().communicators[0].max_bytes, 40U);
  EXPECT_STREQ((*copy)->setup().robot_names[2], "carl");
}

TEST(SetupCopy, RefusesEveryBeginningAndMore) {
  TestRobot robot;
  const std::string bytes = encode_setup({"a.so", "wander", 12}, robot.setup());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto copy = SetupCopy::decode(std::string_view(bytes).substr(0, size));
    ASSERT_FALSE(copy);
    EXPECT_EQ(copy.error().text(), "the setup of an isolated program is damaged");
  }
  EXPECT_FALSE(SetupCopy::decode(bytes + "x"));
}

TEST(ParseMessage, RefusesWhatAChildDoesNotSay) {
  EXPECT_FALSE(parse_message(""));
  EXPECT_FALSE(parse_message("12345678901"));
  EXPECT_FALSE(parse_message(std::string_view("\1\0\0\0\0\0\0\0\0\0\0\0", 12)));
  EXPECT_FALSE(parse_message(std::string_view("\13\0\0\0\0\0\0\0\0\0\0\0", 12)));
  const auto log = parse_message(std::string_view("\6\0\0\0\1\0\0\0\0\0\0\0hi", 14));
  ASSERT_TRUE(log);
  EXPECT_EQ(log->head.kind, MessageKind::kLog);
  EXPECT_EQ(log->head.number, 1U);
  EXPECT_EQ(log->text, "hi");
}

TEST(Describe, Places) {
  EXPECT_EQ(at_place(parse_place("")), "");
  EXPECT_EQ(at_place(parse_place("wander.so")), " at wander.so");
  EXPECT_EQ(at_place(parse_place("a.cpp\n42")), " at a.cpp:42");
  EXPECT_EQ(at_place(parse_place("a.cpp\n42\n_ZN6Wander6decideEi")),
            " at a.cpp:42 in Wander::decide");
  EXPECT_EQ(at_place(parse_place("a.so\n0\nmain")), " at a.so in main");
}

TEST(Describe, Functions) {
  EXPECT_EQ(short_function("_ZN12_GLOBAL__N_16Wander6decideEi"), "Wander::decide");
  EXPECT_EQ(short_function("step"), "step");
  constexpr auto kFrame =
      "rave::detail::program_ops<(anonymous namespace)::Hunt<int>>()::{lambda(void*)#1}::_FUN";
  EXPECT_EQ(short_function("decide", kFrame), "Hunt<int>::decide");
  EXPECT_EQ(short_function("decide", "main"), "decide");
  EXPECT_EQ(short_function("helper", kFrame), "helper");
  EXPECT_EQ(short_function("Wander::operator()(int) const"), "Wander::operator()");
}

}  // namespace
}  // namespace rave::isolation
