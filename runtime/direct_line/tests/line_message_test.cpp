// SPDX-License-Identifier: Apache-2.0
#include "line_message.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rave::direct_line {
namespace {

OrderMessage order_of(std::string_view text) {
  const auto message = parse_line_message(text);
  EXPECT_TRUE(message) << message.error().message;
  return message ? std::get<OrderMessage>(*message) : OrderMessage{};
}

std::string why_refused(std::string_view text) {
  const auto message = parse_line_message(text);
  return message ? "" : message.error().message;
}

TEST(LineMessage, SaysEveryKindOfOrder) {
  const auto drive = order_of(
      R"({"type":"order","id":3,"kind":"drive","robot":"r1","v":0.25,"w":-1,"echo":true})");
  EXPECT_EQ(drive.id, 3U);
  EXPECT_EQ(drive.request.action, request::Action(request::Drive{0.25, -1}));
  EXPECT_EQ(drive.request.robot, "r1");
  EXPECT_TRUE(drive.echo);
  const auto wide = order_of(
      R"({"type":"order","id":3,"kind":"drive","robot":"r1","v":0,"w":0,"vy":0.5,"steering":-1,)"
      R"("throttle":0.5,"brake":0,"gear":-1})");
  EXPECT_EQ(wide.request.action,
            request::Action(request::Drive{0, 0, 0.5, request::Pedals{-1, 0.5, 0, -1}}));
  const auto goal = order_of(
      R"({"type":"order","id":4,"kind":"goal","robot":"r1","points":[[1,2]],"yaw":3,"speed":1})");
  EXPECT_EQ(goal.request.action, request::Action(request::Goal{{1, 2}, 3, 1}));
  EXPECT_EQ(order_of(R"({"type":"order","id":5,"kind":"path","robot":"r1","points":[[1,2],[3,4]]})")
                .request.action,
            request::Action(request::Path{{{1, 2}, {3, 4}}, 0}));
  EXPECT_EQ(order_of(R"({"type":"order","id":6,"kind":"text","robot":"r1","text":"go home"})")
                .request.action,
            request::Action(request::Text{"go home"}));
  EXPECT_EQ(
      order_of(R"({"type":"order","id":7,"kind":"take","robot":"r1","force":true})").request.action,
      request::Action(request::Take{.force = true}));
  EXPECT_EQ(
      order_of(R"({"type":"order","id":7,"kind":"give","robot":"r1","to":"ben"})").request.action,
      request::Action(request::Give{"ben"}));
  for (const char* const word : {"stop", "release", "cancel"}) {
    const auto all = order_of(std::string(R"({"type":"order","id":8,"kind":")") + word + R"("})");
    EXPECT_EQ(all.request.robot, "");
    // Who asks is what the ticket says.
    EXPECT_EQ(all.request.by, "");
    EXPECT_FALSE(all.request.overrides);
  }
}

TEST(LineMessage, RefusesWhatIsNoOrder) {
  const std::string start = R"({"type":"order","id":1,"robot":"r1",)";
  const auto refused = [&start](const char* rest) { return why_refused(start + rest + "}"); };
  EXPECT_EQ(refused(R"("kind":"drive","v":"NaN","w":0)"), "`v`: expected a finite number");
  EXPECT_EQ(refused(R"("kind":"drive","v":null,"w":0)"), "`v`: expected a finite number");
  EXPECT_EQ(refused(R"("kind":"drive","v":NaN,"w":0)"), "not a valid message");
  EXPECT_EQ(refused(R"("kind":"drive","v":1e999,"w":0)"), "not a valid message");
  EXPECT_EQ(refused(R"("kind":"drive","v":0,"w":0,"throttle":1)"), "`steering` is missing");
  EXPECT_EQ(refused(R"("kind":"drive","v":0,"w":0,"throttle":1,"steering":0,"brake":0,"gear":0.5)"),
            "`gear`: expected -1, 0 or 1");
  EXPECT_EQ(refused(R"("kind":"drive","v":101,"w":0)"), "`v`: expected a number from -100 to 100");
  EXPECT_EQ(refused(R"("kind":"drive","v":1)"), "`w` is missing");
  EXPECT_EQ(refused(R"("kind":"goal","points":[])"), "`points`: expected one for each robot, 1");
  EXPECT_EQ(refused(R"("kind":"goal","points":[[1]])"),
            "`points`: expected pairs of x and y in metres, within ±1000000 m");
  EXPECT_EQ(refused(R"("kind":"goal","points":[[1,1e7]])"),
            "`points`: expected pairs of x and y in metres, within ±1000000 m");
  EXPECT_EQ(refused(R"("kind":"path","points":[[1,1]])"), "a path has 1 point; expected 2 to 1000");
  EXPECT_EQ(refused(R"("kind":"text","text":"")"), "`text`: expected text");
  EXPECT_EQ(refused(R"("kind":"stop","by":"ben")"), "the message has unknown members");
  for (const char* const other : {"set", "edit", "arm", "hand_over", "list"}) {
    EXPECT_NE(refused((R"("kind":")" + std::string(other) + "\"").c_str()).find("`kind`: expected"),
              std::string::npos)
        << other;
  }
  std::string many = R"("kind":"path","points":[[0,0])";
  for (int i = 0; i < 10'000; ++i) many += ",[0,0]";
  EXPECT_EQ(refused((many + "]").c_str()), "a path has 10001 points; expected 2 to 1000");
  EXPECT_EQ(why_refused(R"({"type":"order","id":1,"kind":"drive","v":0,"w":0})"),
            "`robot`: expected a name");
  EXPECT_EQ(why_refused("[]"), "not a valid message");
  EXPECT_EQ(why_refused(""), "not a valid message");
  EXPECT_EQ(why_refused(R"({"type":"shutdown"})"), "`type`: expected hello, order, ping or ticket");
  EXPECT_EQ(why_refused(R"({"type":"ping","id":-1})"), "`id`: expected a whole number from 0");
}

}  // namespace
}  // namespace rave::direct_line
