// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/control/obstacle_edits.hpp"

namespace rave::control {
namespace {

using What = Request::What;
using Kind = runtime::RunRequest::Kind;

TEST(Protocol, RequestsComeBackAsTheyWere) {
  for (const Request& request :
       {Request{}, request_of({Kind::kStop, "", "", ""}),
        request_of({Kind::kStop, "a \"robot\"\n", "", ""}), request_of({Kind::kArm, "b", "", ""}),
        request_of({Kind::kRelease, "b", "", ""}),
        request_of({Kind::kSet, "prey", "body.scale", "1.5"}), Request{What::kPause},
        Request{What::kStep, 12}, request_of({Kind::kList, "", "", ""}),
        request_of({Kind::kHandOver, "create", "", "real"}),
        request_of({Kind::kResetShadow, "create", "", ""}),
        request_of({Kind::kResetShadow, "", "", ""})}) {
    std::string line = write_request(request);
    ASSERT_EQ(line.back(), '\n');
    line.pop_back();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto read = parse_request(line);
    ASSERT_TRUE(read) << line << ": " << read.error().message;
    EXPECT_EQ(*read, request) << line;
  }
}

Request edit_of(const std::string& text) {
  Request request = request_of({Kind::kEdit, "", "", "", "anna"});
  auto edit = config::read_edit(text, "test");
  EXPECT_TRUE(edit) << edit.error().text();
  request.run.edit = *std::move(edit);
  return request;
}

TEST(Protocol, EditsComeBackAsTheyWere) {
  for (const Request& request :
       {edit_of("{add_obstacle: {name: a, disc_radius_m: 0.2, x_m: -0.0, yaw_deg: 1e-17}}"),
        edit_of("{add_obstacle: {name: a, polygon_m: [[0, 0], [0.1, 0], [0, 3e5]], z_m: [0.1, 0.7],"
                " layer: mapped_real, barcode: 7, colour: '#ff0010'}}"),
        edit_of("{move_obstacle: {name: a, x_m: 1, y_m: 0.30000000000000004}}"),
        edit_of("{remove_obstacle: h\u00e4llo}")}) {
    std::string line = write_request(request);
    line.pop_back();
    const auto read = parse_request(line);
    ASSERT_TRUE(read) << line << ": " << read.error().message;
    EXPECT_EQ(*read, request) << line;
    EXPECT_EQ(write_request(*read), line + "\n");
  }
}

TEST(Protocol, SaysWhatIsWrongWithAnEdit) {
  const auto why = [](const std::string& edit) {
    const auto request = parse_request(R"({"rave":1,"do":"edit")" + edit + "}");
    return request ? "nothing" : request.error().message;
  };
  EXPECT_EQ(why(""),
            "`edit` is missing: expected an object with one of `add_obstacle`, `move_obstacle` and "
            "`remove_obstacle`");
  EXPECT_NE(why(R"(,"edit":{})").find("an edit has 0 of `add_obstacle`"), std::string::npos);
  EXPECT_NE(why(R"(,"edit":{"add_obstacle":{"name":"a","disc_radius_m":1},"remove_obstacle":"b"})")
                .find("an edit has 2 of"),
            std::string::npos);
  EXPECT_NE(why(R"(,"edit":{"add_obstacle":{"name":"a"}})").find("`disc_radius_m`"),
            std::string::npos);
  EXPECT_NE(why(R"(,"edit":{"move_obstacle":{"name":"a","x":1}})").find("expected `x_m`"),
            std::string::npos);
  EXPECT_NE(why(R"(,"edit":{"move_obstacle":{"name":"a","x_m":"1"}})").find("`x_m`"),
            std::string::npos);
  // YAML in a text, as requests had it before.
  EXPECT_NE(why(R"(,"edit":"{remove_obstacle: a}")").find("a mapping"), std::string::npos);
  const auto before = parse_request(R"({"rave":1,"do":"add","value":"{name: a}"})");
  ASSERT_FALSE(before);
  EXPECT_NE(before.error().message.find("`do` to be one of"), std::string::npos);
  EXPECT_NE(before.error().message.find("edit"), std::string::npos);
}

TEST(RecordedEdits, OlderRecordingsAreRead) {
  const auto edit = [](const char* kind, const char* key, const char* value) {
    const auto read = runtime::recorded_edit(kind, key, value);
    return !read ? "none" : *read ? config::write_edit(**read) : (*read).error().message;
  };
  const config::ObstacleEdit crate =
      *edit_of("{add_obstacle: {name: crate, box_m: [0.5, 0.3], x_m: 1}}").run.edit;
  const std::string text = config::write_edit(crate);
  EXPECT_EQ(edit("edit", "", text.c_str()), text);
  EXPECT_EQ(edit("add", "", "{name: \"crate\", box_m: [0.5, 0.3], x_m: 1}"), text);
  EXPECT_EQ(edit("add", "", "name: crate\nbox_m: [0.5, 0.3]\nx_m: 1\n"), text);
  EXPECT_EQ(edit("move", "", "{name: crate, x_m: 2}"),
            config::write_edit(*edit_of("{move_obstacle: {name: crate, x_m: 2}}").run.edit));
  EXPECT_EQ(edit("remove", "crate", ""), R"({"remove_obstacle": "crate"})");
  EXPECT_EQ(edit("set", "program.speed", "1"), "none");
  EXPECT_NE(edit("add", "", "[").find("YAML"), std::string::npos) << edit("add", "", "[");
  EXPECT_NE(edit("edit", "", "{}").find("an edit has 0 of"), std::string::npos);
}

TEST(Protocol, SaysWhyAPathIsNone) {
  const auto why = [](std::size_t points) {
    std::string line = R"({"rave":1,"do":"path","robot":"r1","points":[[0,0])";
    for (std::size_t i = 1; i < points; ++i) line += ",[0,1]";
    return parse_request(line + "]}").error().message;
  };
  EXPECT_EQ(why(1), "a path has 1 point; expected 2 to 1000");
  EXPECT_EQ(why(1001), "a path has 1001 points; expected 2 to 1000");
  EXPECT_EQ(why(9000), "a path has 9000 points; expected 2 to 1000");
  EXPECT_EQ(why(20'000), "the line is longer than 65536 bytes, which hold a path of 1000 points");
}

TEST(Protocol, AnyPathThatIsTakenFitsIntoALine) {
  Request path =
      request_of({Kind::kPath, std::string(64, 'r'), "", "", std::string(64, 'a'), true, ~0ULL});
  for (int i = 0; i < 1000; ++i)
    path.run.points.push_back({-1.2345678901234567e-100, -1.2345678901234567e-100});
  path.run.speed_mps = 0.1234567890123456;
  const std::string line = write_request(path);
  EXPECT_LE(line.size(), kMaxLineBytes);
  EXPECT_LE(line.size(), std::size_t{rave_wire_kMaxRequestBytes});
  EXPECT_TRUE(parse_request(std::string_view(line).substr(0, line.size() - 1)));
}

TEST(Protocol, RefusesWhatIsNoLineOfAChat) {
  for (const char* const rest :
       {R"("key":"0 commander all","value":"a","by":"anna")",
        R"("key":"1 boss all","value":"a","by":"anna")",
        R"("key":"1 commander nobody","value":"a","by":"anna")",
        R"("key":"1 commander user","value":"a","by":"anna")",
        R"("key":"1 commander all ben","value":"a","by":"anna")",
        R"("key":"1 commander all","value":"","by":"anna")",
        R"("key":"1 commander all","value":"a")",
        R"("key":"-1 commander all","value":"a","by":"b")",
        R"("key":"1 commander all","value":"a","by":"anna","robot":"r1")",
        R"("key":"","value":"a","by":"anna")", R"("value":"a","by":"anna")"}) {
    EXPECT_FALSE(parse_request(R"({"rave":1,"do":"chat",)" + std::string(rest) + "}")) << rest;
  }
  for (const char* const page : {"0", "-1", "1.5", "\"1\""}) {
    EXPECT_FALSE(parse_request(R"({"rave":1,"do":"take","robot":"r1","by":"a","page":)" +
                               std::string(page) + "}"))
        << page;
  }
}

std::vector<Request> orders() {
  Request drive = request_of({Kind::kDrive, "r1", "", "", "anna"});
  drive.run.v_mps = 0.1;
  drive.run.w_radps = -1.0 / 3;
  Request goal = request_of({Kind::kGoal, "r1", "", "", "anna", true});
  goal.run.points = {{1.5, -2}};
  goal.run.yaw_rad = 0.25;
  goal.run.speed_mps = 0.3;
  Request path = request_of({Kind::kPath, "r1", "", ""});
  path.run.points = {{0, 0}, {1e-9, 7}, {3, 4}};
  Request place = request_of({Kind::kPlace, "r1", "", ""});
  place.run.points = {{1, 2}};
  Request stop = request_of({Kind::kStop, "r1", "", "", "anna"});
  return {drive,
          goal,
          path,
          place,
          stop,
          request_of({Kind::kCancel, "", "", ""}),
          request_of({Kind::kCancel, "r1", "", "", "bert"}),
          request_of({Kind::kText, "r1", "", "h\u00e4llo"}),
          request_of({Kind::kTake, "r1", "", "force", "anna"}),
          request_of({Kind::kTake, "r1", "", "", "anna"}),
          request_of({Kind::kGive, "r1", "", "bert", "anna"}),
          request_of({Kind::kTake, "r1", "", "", "anna", false, 0xffffffffffffffffULL}),
          request_of({Kind::kChat, "", "3 commander user ben a", "psst", "anna"}),
          request_of({Kind::kChat, "", "1 observer all", "two\nlines", "the operator"})};
}

TEST(Protocol, OrdersComeBackAsTheyWere) {
  for (const Request& request : orders()) {
    std::string line = write_request(request);
    line.pop_back();
    const auto read = parse_request(line);
    ASSERT_TRUE(read) << line << ": " << read.error().message;
    EXPECT_EQ(*read, request) << line;
  }
}

TEST(Protocol, RefusesOrdersThatAreNone) {
  const std::string many(1001, 'a');
  std::string points = "[[0,0]";
  for (int i = 0; i < 1000; ++i) points += ",[0,0]";
  for (const std::string& line :
       {std::string(R"({"rave":1,"do":"drive","robot":"a","v":1})"),
        std::string(R"({"rave":1,"do":"drive","v":1,"w":0})"),
        std::string(R"({"rave":1,"do":"drive","robot":"a","v":"1","w":0})"),
        std::string(R"({"rave":1,"do":"drive","robot":"a","v":1e999,"w":0})"),
        std::string(R"({"rave":1,"do":"drive","robot":"a","v":NaN,"w":0})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a"})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a","points":[]})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a","points":[[1]]})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a","points":[[1,2],[3,4]]})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a","points":[["1",2]]})"),
        std::string(R"({"rave":1,"do":"goal","robot":"a","points":[[1,2]],"yaw":"x"})"),
        std::string(R"({"rave":1,"do":"path","robot":"a","points":[[1,2]]})"),
        R"({"rave":1,"do":"path","robot":"a","points":)" + points + "]}",
        std::string(R"({"rave":1,"do":"place","robot":"a","points":[[1,2]],"speed":1})"),
        std::string(R"({"rave":1,"do":"text","robot":"a"})"),
        R"({"rave":1,"do":"text","robot":"a","value":")" + many + "\"}",
        std::string(R"({"rave":1,"do":"text","value":"a"})"),
        std::string(R"({"rave":1,"do":"take"})"),
        std::string(R"({"rave":1,"do":"stop","by":7})"),
        std::string(R"({"rave":1,"do":"stop","overrides":"yes"})"),
        std::string(R"({"rave":1,"do":"status","by":"anna"})"),
        R"({"rave":1,"do":"stop","by":")" + std::string(65, 'a') + "\"}"}) {
    EXPECT_FALSE(parse_request(line)) << line;
  }
}

TEST(Protocol, AStatusSaysWhoDrivesAndWhat) {
  Answer answer{true, "", {}};
  answer.status.scenario = "small";
  runtime::RunStatus::Robot& robot = answer.status.robots.emplace_back();
  robot.name = "r1";
  robot.lease = "anna";
  robot.takes = {"drive", "goal"};
  robot.order = "goal 1.00, 2.00";
  robot.lacks = "pose lost: its pose is not reported";
  robot.elsewhere = true;
  robot.changed = {{"body.scale", "2"}, {"program.mode", "fast, \"far\""}};
  std::string line = write_answer(answer);
  line.pop_back();
  const auto read = parse_answer(line);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->status.robots.size(), 1U);
  EXPECT_EQ(read->status.robots[0].lease, "anna");
  EXPECT_EQ(read->status.robots[0].takes, robot.takes);
  EXPECT_EQ(read->status.robots[0].order, "goal 1.00, 2.00");
  EXPECT_EQ(read->status.robots[0].changed, robot.changed);
  EXPECT_EQ(read->status.robots[0].lacks, robot.lacks);
  EXPECT_TRUE(read->status.robots[0].elsewhere);
  for (const char* const bad : {R"("takes":"all")", R"("changed":[])", R"("changed":{"a":1})"}) {
    EXPECT_FALSE(parse_answer(
        R"({"good":true,"text":"","status":{"scenario":"s","sim_s":0,"duration_s":1,"pace":1,)"
        R"("live":false,"paused":false,"robots":[{"name":"a","simulated":true,"armed":true,)"
        R"("stopped":false,)" +
        std::string(bad) + "}]}}"))
        << bad;
  }
}

TEST(Protocol, RefusesWhatIsNotExactlyARequest) {
  for (const char* const line :
       {"",
        "stop",
        "[]",
        "null",
        "{}",
        R"({"do":"stop"})",
        R"({"rave":2,"do":"stop"})",
        R"({"rave":1,"do":"fly"})",
        R"({"rave":1,"do":7})",
        R"({"rave":1})",
        R"({"rave":1,"do":"stop","robot":7})",
        R"({"rave":1,"do":"stop","robot":"a","robot":"b"})",
        R"({"rave":1,"do":"stop","rabot":"a"})",
        R"({"rave":1,"do":"pause","robot":"a"})",
        R"({"rave":1,"do":"set","robot":"a","key":"b"})",
        R"({"rave":1,"do":"set","robot":"a","key":"b","value":1})",
        R"({"rave":1,"do":"step","count":0})",
        R"({"rave":1,"do":"step","count":-1})",
        R"({"rave":1,"do":"step","count":1.5})",
        R"({"rave":1,"do":"stop"} x)",
        R"({"rave":1,"do":"edit"})",
        R"({"rave":1,"do":"edit","edit":null})",
        R"({"rave":1,"do":"edit","edit":{"remove_obstacle":7}})",
        R"({"rave":1,"do":"edit","edit":{"remove_obstacle":"a"},"key":"a"})",
        R"({"rave":1,"do":"stop","edit":{"remove_obstacle":"a"}})",
        R"({"rave":1,"do":"list","robot":"a"})",
        R"({"rave":1,"do":"hand_over","value":"real"})",
        R"({"rave":1,"do":"hand_over","robot":"a"})",
        R"({"rave":1,"do":"hand_over","robot":"a","value":1})",
        R"({"rave":1,"do":"reset_shadow","robot":7})",
        R"({"rave":1,"do":"stop","robot":"a\u0000b"})"}) {
    const auto read = parse_request(line);
    EXPECT_FALSE(read) << line;
    if (!read) {
      EXPECT_FALSE(read.error().message.empty()) << line;
    }
  }
  EXPECT_FALSE(parse_request(std::string(kMaxLineBytes + 1, ' ')));
  EXPECT_FALSE(parse_request(std::string(kMaxLineBytes, '[')));
}

TEST(Protocol, HandOversAndShadowsAreToldWithTheirRobots) {
  Answer answer;
  answer.good = true;
  answer.status.scenario = "lab";
  auto& robot = answer.status.robots.emplace_back();
  robot.name = "create";
  robot.hand_over = {true, 2, 1, "simulated -> real", 1.5, -2, 0.25};
  robot.shadow = {
      true, 3, 0.125, 0.5, 0.25, 0.75, {{"laser", "m", 0.0625, 0.5}}, Pose2{0.25, -0.5, 1}};
  answer.status.robots.push_back({"plain", true, true, false, {}, {}});
  const auto read = parse_answer(write_answer(answer));
  ASSERT_TRUE(read) << read.error().text();
  ASSERT_EQ(read->status.robots.size(), 2U);
  EXPECT_EQ(read->status.robots[0].hand_over, answer.status.robots[0].hand_over);
  EXPECT_EQ(read->status.robots[0].shadow, answer.status.robots[0].shadow);
  EXPECT_FALSE(read->status.robots[1].hand_over);
  EXPECT_FALSE(read->status.robots[1].shadow);
  EXPECT_FALSE(parse_answer(
      R"({"good":true,"text":"","status":{"scenario":"a","sim_s":0,"duration_s":1,"pace":1,)"
      R"("live":false,"paused":false,"robots":[{"name":"b","simulated":true,"armed":true,)"
      R"("stopped":false,"hand_over":{"under_way":true,"made":-1,"refused":0,"last":""}}]}})"));
}

TEST(Protocol, AnswersComeBackAsTheyWere) {
  Answer answer;
  answer.good = true;
  answer.text = "it's \u00e4ll right";
  answer.status.scenario = "s";
  answer.status.sim_s = 1.25;
  answer.status.lateness = {1000, 60, 2.5, 1.25, "decide"};
  answer.status.waits_for = "left and right";
  answer.status.run = "0123456789abcdef";
  answer.status.robots = {{"a", true, true, false}, {"b", false, false, true}};
  const auto read = parse_answer(write_answer(answer));
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->good);
  EXPECT_EQ(read->text, answer.text);
  EXPECT_EQ(read->status.sim_s, 1.25);
  EXPECT_EQ(read->status.lateness, answer.status.lateness);
  EXPECT_EQ(read->status.waits_for, "left and right");
  EXPECT_EQ(read->status.run, "0123456789abcdef");
  ASSERT_EQ(read->status.robots.size(), 2U);
  EXPECT_EQ(read->status.robots[1].name, "b");
  EXPECT_TRUE(read->status.robots[1].stopped);
  EXPECT_FALSE(parse_answer(R"({"good":1,"text":""})"));
  EXPECT_FALSE(parse_answer(
      R"({"good":true,"text":"","status":{"scenario":"a","sim_s":0,"duration_s":1,"pace":1,)"
      R"("live":false,"paused":false,"robots":[],"lateness":{"deadlines":-1,"missed":0,)"
      R"("worst_s":0,"behind_s":0,"phase":""}}})"));
}

}  // namespace
}  // namespace rave::control
