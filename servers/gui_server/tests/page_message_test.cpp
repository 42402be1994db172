// SPDX-License-Identifier: Apache-2.0
#include "page_message.hpp"

#include <gtest/gtest.h>

namespace rave::gui_server {
namespace {

TEST(PageMessage, LooksAreReadAndSortedOnce) {
  const auto message = parse_page_message(
      R"({"type":"look","poses":true,"true_poses":false,"parts":true,"max_hz":25,"readings":[[3,1],[0,2],[3,1]]})");
  ASSERT_TRUE(message) << message.error().text();
  const auto& look = std::get<LookMessage>(*message);
  EXPECT_TRUE(look.poses);
  EXPECT_TRUE(look.parts);
  EXPECT_EQ(look.max_hz, 25);
  EXPECT_EQ(look.readings, (std::vector<LookedAt>{{0, 2}, {3, 1}}));
}

TEST(PageMessage, RightsAreSetOfARoleOrAUser) {
  const auto role = parse_page_message(
      R"({"type":"set_right","role":"observer","class":"readings","reach":["green"]})");
  ASSERT_TRUE(role) << role.error().text();
  EXPECT_EQ(std::get<SetRightMessage>(*role).change,
            (RightChange{
                Role::kObserver, {}, InfoClass::kReadings, Reach{Reach::Kind::kTeams, {"green"}}}));
  const auto user =
      parse_page_message(R"({"type":"set_right","user":"ben","class":"log","reach":null})");
  ASSERT_TRUE(user) << user.error().text();
  EXPECT_EQ(std::get<SetRightMessage>(*user).change, (RightChange{{}, "ben", InfoClass::kLog, {}}));
}

struct Refused {
  const char* text;
  const char* reason;
};

class Refusals : public testing::TestWithParam<Refused> {};

TEST_P(Refusals, SayWhatWasExpected) {
  const auto message = parse_page_message(GetParam().text);
  ASSERT_FALSE(message);
  EXPECT_NE(message.error().message.find(GetParam().reason), std::string::npos)
      << message.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    All, Refusals,
    testing::Values(
        Refused{"", "expected a JSON object"}, Refused{"[]", "expected a JSON object"},
        Refused{"{", "expected a JSON object"}, Refused{R"({"type":"hack"})", "unknown type"},
        Refused{R"({"sequence":1})", "`type` is missing"},
        Refused{R"({"type":"ack"})", "`sequence` is missing"},
        Refused{R"({"type":"ack","sequence":-1})", "whole number"},
        Refused{R"({"type":"ack","sequence":1.5})", "whole number"},
        Refused{R"({"type":"ack","sequence":4294967296})", "whole number"},
        Refused{R"({"type":"ack","sequence":1,"more":2})", "unknown members"},
        Refused{R"({"type":"transport","do":"fly"})", "expected play"},
        Refused{R"({"type":"transport","do":"seek"})", "`value` is missing"},
        Refused{R"({"type":"transport","do":"seek","value":"1"})", "finite number"},
        Refused{R"({"type":"transport","do":"seek","value":1e999})", "JSON object"},
        Refused{R"({"type":"set_right","class":"pose","reach":"none"})", "`role` or `user`"},
        Refused{R"({"type":"set_right","role":"root","class":"pose","reach":"none"})", "observer"},
        Refused{R"({"type":"set_right","role":"observer","class":"poses","reach":"none"})",
                "`class`"},
        Refused{R"({"type":"set_right","role":"observer","class":"pose","reach":"some"})",
                "none, own, all"},
        Refused{R"({"type":"set_right","role":"observer","class":"pose","reach":[1]})", "teams"},
        Refused{R"({"type":"see_as","role":"observer","user":"ben"})", "not both"},
        Refused{R"({"type":"see_as","user":""})", "expected a name"},
        Refused{R"({"type":"halt","do":"go","slots":[]})", "stop or release"},
        Refused{R"({"type":"halt","do":"stop","slots":[-1]})", "whole number"},
        Refused{
            R"({"type":"look","poses":1,"true_poses":false,"parts":true,"max_hz":25,"readings":[]})",
            "true or false"},
        Refused{
            R"({"type":"look","poses":true,"true_poses":false,"parts":true,"max_hz":0,"readings":[]})",
            "1 to 60"},
        Refused{
            R"({"type":"look","poses":true,"true_poses":false,"parts":true,"max_hz":9,"readings":[[1]]})",
            "pairs"}));

}  // namespace
}  // namespace rave::gui_server
