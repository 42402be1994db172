// SPDX-License-Identifier: Apache-2.0
#include "rave/request/request.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rave::request {
namespace {

std::vector<Action> one_of_each() {
  config::ObstacleEdit edit;
  edit.remove_obstacle = codec::Located<std::string>("box");
  return {Stop{},
          Release{},
          Arm{},
          Set{"program.speed_mps", "0.5"},
          Edit{edit},
          ListObstacles{},
          HandOver{"real"},
          ResetShadow{},
          Drive{0.5, -0.1},
          Goal{{1, 2}, 0.5, 0.3},
          Path{{{1, 2}, {3, 4}}, 0},
          Cancel{},
          Text{"go \"home\"\n"},
          Place{{0.1, -7}, std::nullopt},
          Take{true},
          Give{"ben"},
          Chat{3, "commander", Addressee::kUser, "ben", "hello"}};
}

std::string error_of(std::string_view line) {
  const auto request = from_json(line);
  return request ? "read: " + to_json_line(*request) : request.error().message;
}

TEST(Request, ADriveIsAsWideAsTheDrive) {
  for (const Drive& drive : {Drive{0, 0, 0.5}, Drive{0.1, 0, 0, Pedals{-0.5, 1, 0.25, -1}}}) {
    const Request request{drive, "r1", "anna"};
    const auto again = from_json(to_json_line(request));
    ASSERT_TRUE(again.has_value()) << to_json_line(request) << ": " << again.error().message;
    EXPECT_EQ(*again, request);
  }
  EXPECT_NE(error_of(R"({"do":"drive","robot":"a","v":0,"w":0,"pedals":{"gear":0.5}})")
                .find("expected -1, 0 or 1"),
            std::string::npos);
  EXPECT_TRUE((Drive{0, 0, 0, Pedals{}}.stands()));
  EXPECT_FALSE((Drive{0, 0, 0, Pedals{.throttle = 0.1}}.stands()));
  EXPECT_FALSE((Drive{0, 0, 0.1}.stands()));
}

TEST(Request, EachIsReadAsItWasWritten) {
  const auto all = one_of_each();
  ASSERT_EQ(all.size(), action_names().size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    Request request{all[i], "r1", "anna", true, 7};
    if (is_of_no_robot(all[i])) request.robot.clear();
    if (only_reads(all[i])) request = {all[i]};
    const auto again = from_json(to_json_line(request));
    ASSERT_TRUE(again.has_value()) << to_json_line(request) << ": " << again.error().message;
    EXPECT_EQ(*again, request);
    EXPECT_EQ(name_of(all[i]), action_names()[i]);
  }
}

TEST(Request, SaysNoMoreThanItMust) {
  EXPECT_EQ(to_json_line({Stop{}}), R"({"do": "stop"})");
  EXPECT_EQ(to_json_line({Drive{0, 0}, "r1"}), R"({"do": "drive", "robot": "r1", "v": 0, "w": 0})");
  EXPECT_EQ(to_json_line({Goal{{1.5, -2}, std::nullopt, 0.3}, "prey", "anna"}),
            R"({"do": "goal", "robot": "prey", "by": "anna", "point": [1.5, -2], "speed": 0.3})");
}

TEST(Request, RefusesWithReasons) {
  EXPECT_EQ(error_of(R"({"do": "goal", "point": [1, 2]})"), "`goal` needs a robot");
  EXPECT_EQ(error_of(R"({"do": "path", "robot": "r", "points": [[1, 2]]})"),
            "a path has 1 point; expected 2 to 1000");
  EXPECT_EQ(error_of(R"({"do": "gaol", "robot": "r"})").find("`do`: found the text \"gaol\""), 0U);
  EXPECT_NE(error_of(R"({"do": "drive", "robot": "r", "v": 101, "w": 0})").find("100"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"do": "stop", "speed": 1})").find("unknown key `speed`"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"do": "list", "robot": "r"})").find("concerns no robot"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"do": "list", "by": "anna"})").find("unexpected author"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"do": "chat", "number": 1, "role": "observer", "text": "a"})")
                .find("needs its author"),
            std::string::npos);
  EXPECT_NE(error_of(R"({"do": "edit", "edit": {}})").find("add_obstacle"), std::string::npos);
}

TEST(Request, TraitsFollowTheKind) {
  EXPECT_TRUE(is_order(Cancel{}));
  EXPECT_FALSE(needs_robot(Cancel{}));
  EXPECT_FALSE(is_order(Stop{}));
  EXPECT_TRUE(is_of_lease(Give{}));
  EXPECT_TRUE(only_reads(ListObstacles{}));
  EXPECT_EQ(order_kind(Place{}), OrderKind::kPlace);
  EXPECT_EQ(order_kind(Drive{}), OrderKind::kDrive);
  for (const Action& action : one_of_each()) {
    const auto order = order_of(action);
    EXPECT_EQ(order.has_value(), is_order(action));
    if (order) {
      EXPECT_EQ(action_of(*order), action);
    }
  }
}

}  // namespace
}  // namespace rave::request
