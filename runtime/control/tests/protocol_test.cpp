// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/control/obstacle_edits.hpp"

namespace rave::control {
namespace {

TEST(Protocol, RequestsComeBackAsTheyWere) {
  for (const Request& request :
       {Request{}, request_of({request::Stop()}), request_of({request::Stop(), "a \"robot\"\n"}),
        request_of({request::Arm(), "b"}), request_of({request::Release(), "b"}),
        request_of({request::Set{"body.scale", "1.5"}, "prey"}), Request{Pause()},
        Request{Resume()}, Request{Step{12}}, Request{End()},
        request_of({request::ListObstacles()}), request_of({request::HandOver{"real"}, "create"}),
        request_of({request::ResetShadow(), "create"}), request_of({request::ResetShadow()})}) {
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
  auto edit = config::read_edit(text, "test");
  EXPECT_TRUE(edit) << edit.error().text();
  return request_of({request::Edit{*std::move(edit)}, {}, "anna"});
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
    const auto request = parse_request(R"({"rave":2,"do":"edit")" + edit + "}");
    return request ? "nothing" : request.error().message;
  };
  EXPECT_EQ(why(""),
            "expected `edit`, an object with one of `add_obstacle`, `move_obstacle` and "
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
  EXPECT_NE(why(R"(,"edit":"{remove_obstacle: a}")").find("an object with one of"),
            std::string::npos);
  const auto before = parse_request(R"({"rave":2,"do":"add","value":"{name: a}"})");
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
      edit_of("{add_obstacle: {name: crate, box_m: [0.5, 0.3], x_m: 1}}")
          .run.as<request::Edit>()
          ->edit;
  const std::string text = config::write_edit(crate);
  EXPECT_EQ(edit("edit", "", text.c_str()), text);
  EXPECT_EQ(edit("add", "", "{name: \"crate\", box_m: [0.5, 0.3], x_m: 1}"), text);
  EXPECT_EQ(edit("add", "", "name: crate\nbox_m: [0.5, 0.3]\nx_m: 1\n"), text);
  EXPECT_EQ(edit("move", "", "{name: crate, x_m: 2}"),
            config::write_edit(
                edit_of("{move_obstacle: {name: crate, x_m: 2}}").run.as<request::Edit>()->edit));
  EXPECT_EQ(edit("remove", "crate", ""), R"({"remove_obstacle": "crate"})");
  EXPECT_EQ(edit("set", "program.speed", "1"), "none");
  EXPECT_NE(edit("add", "", "[").find("YAML"), std::string::npos) << edit("add", "", "[");
  EXPECT_NE(edit("edit", "", "{}").find("an edit has 0 of"), std::string::npos);
}

TEST(Protocol, SaysWhyAPathIsNone) {
  const auto why = [](std::size_t points) {
    std::string line = R"({"rave":2,"do":"path","robot":"r1","points":[[0,0])";
    for (std::size_t i = 1; i < points; ++i) line += ",[0,1]";
    return parse_request(line + "]}").error().message;
  };
  EXPECT_EQ(why(1), "a path has 1 point; expected 2 to 1000");
  EXPECT_EQ(why(1001), "a path has 1001 points; expected 2 to 1000");
  EXPECT_EQ(why(9000), "a path has 9000 points; expected 2 to 1000");
  EXPECT_EQ(why(20'000), "the line is longer than 65536 bytes, which hold a path of 1000 points");
}

TEST(Protocol, AnyPathThatIsTakenFitsIntoALine) {
  const Vec2 long_numbers{-1.2345678901234567e-100, -1.2345678901234567e-100};
  const Request path =
      request_of({request::Path{std::vector<Vec2>(1000, long_numbers), 0.1234567890123456},
                  std::string(64, 'r'), std::string(64, 'a'), true, (std::uint64_t{1} << 53U) - 1});
  const std::string line = write_request(path);
  EXPECT_LE(line.size(), kMaxLineBytes);
  EXPECT_LE(line.size(), std::size_t{rave_wire_kMaxRequestBytes});
  EXPECT_TRUE(parse_request(std::string_view(line).substr(0, line.size() - 1)));
}

TEST(Protocol, RefusesWhatIsNoLineOfAChat) {
  for (const char* const rest :
       {R"("number":0,"role":"commander","to":"all","text":"a","by":"anna")",
        R"("number":1,"role":"boss","to":"all","text":"a","by":"anna")",
        R"("number":1,"role":"commander","to":"nobody","text":"a","by":"anna")",
        R"("number":1,"role":"commander","to":"user","text":"a","by":"anna")",
        R"("number":1,"role":"commander","to":"all","name":"ben","text":"a","by":"anna")",
        R"("number":1,"role":"commander","to":"all","text":"","by":"anna")",
        R"("number":1,"role":"commander","to":"all","text":"a")",
        R"("number":-1,"role":"commander","to":"all","text":"a","by":"b")",
        R"("number":1,"role":"commander","to":"all","text":"a","by":"anna","robot":"r1")",
        R"("text":"a","by":"anna")"}) {
    EXPECT_FALSE(parse_request(R"({"rave":2,"do":"chat",)" + std::string(rest) + "}")) << rest;
  }
  for (const char* const page : {"0", "-1", "1.5", "\"1\""}) {
    EXPECT_FALSE(parse_request(R"({"rave":2,"do":"take","robot":"r1","by":"a","page":)" +
                               std::string(page) + "}"))
        << page;
  }
}

std::vector<Request> orders() {
  return {
      request_of({request::Drive{0.1, -1.0 / 3}, "r1", "anna"}),
      request_of({request::Goal{{1.5, -2}, 0.25, 0.3}, "r1", "anna", true}),
      request_of({request::Path{{{0, 0}, {1e-9, 7}, {3, 4}}, 0}, "r1"}),
      request_of({request::Place{{1, 2}, {}}, "r1"}),
      request_of({request::Stop(), "r1", "anna"}),
      request_of({request::Cancel()}),
      request_of({request::Cancel(), "r1", "bert"}),
      request_of({request::Text{"h\u00e4llo"}, "r1"}),
      request_of({request::Take{.force = true}, "r1", "anna"}),
      request_of({request::Take{.drives = true}, "r1", "anna", false, 7}),
      request_of({request::Take(), "r1", "anna"}),
      request_of({request::Give{"bert"}, "r1", "anna"}),
      request_of({request::Take(), "r1", "anna", false, 0xffffffffffffffffULL}),
      request_of(
          {request::Chat{3, "commander", request::Addressee::kUser, "ben a", "psst"}, {}, "anna"}),
      request_of({request::Chat{1, "observer", request::Addressee::kAll, {}, "two\nlines"},
                  {},
                  "the operator"})};
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
       {std::string(R"({"rave":2,"do":"drive","robot":"a","v":1})"),
        std::string(R"({"rave":2,"do":"drive","v":1,"w":0})"),
        std::string(R"({"rave":2,"do":"drive","robot":"a","v":"1","w":0})"),
        std::string(R"({"rave":2,"do":"drive","robot":"a","v":1e999,"w":0})"),
        std::string(R"({"rave":2,"do":"drive","robot":"a","v":NaN,"w":0})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a"})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a","point":[]})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a","point":[1]})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a","point":[1,2,3]})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a","point":["1",2]})"),
        std::string(R"({"rave":2,"do":"goal","robot":"a","point":[1,2],"yaw":"x"})"),
        std::string(R"({"rave":2,"do":"path","robot":"a","points":[[1,2]]})"),
        R"({"rave":2,"do":"path","robot":"a","points":)" + points + "]}",
        std::string(R"({"rave":2,"do":"place","robot":"a","point":[1,2],"speed":1})"),
        std::string(R"({"rave":2,"do":"text","robot":"a"})"),
        R"({"rave":2,"do":"text","robot":"a","text":")" + many + "\"}",
        std::string(R"({"rave":2,"do":"text","text":"a"})"),
        std::string(R"({"rave":2,"do":"take"})"),
        std::string(R"({"rave":2,"do":"stop","by":7})"),
        std::string(R"({"rave":2,"do":"stop","overrides":"yes"})"),
        std::string(R"({"rave":2,"do":"status","by":"anna"})"),
        R"({"rave":2,"do":"stop","by":")" + std::string(65, 'a') + "\"}"}) {
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
        R"({"rave":9,"do":"stop"})",
        R"({"rave":2,"do":"fly"})",
        R"({"rave":2,"do":7})",
        R"({"rave":2})",
        R"({"rave":2,"do":"stop","robot":7})",
        R"({"rave":2,"do":"stop","robot":"a","robot":"b"})",
        R"({"rave":2,"do":"stop","rabot":"a"})",
        R"({"rave":2,"do":"pause","robot":"a"})",
        R"({"rave":2,"do":"set","robot":"a","key":"b"})",
        R"({"rave":2,"do":"set","robot":"a","key":"b","value":1})",
        R"({"rave":2,"do":"step","count":0})",
        R"({"rave":2,"do":"step","count":-1})",
        R"({"rave":2,"do":"step","count":1.5})",
        R"({"rave":2,"do":"stop"} x)",
        R"({"rave":2,"do":"edit"})",
        R"({"rave":2,"do":"edit","edit":null})",
        R"({"rave":2,"do":"edit","edit":{"remove_obstacle":7}})",
        R"({"rave":2,"do":"edit","edit":{"remove_obstacle":"a"},"key":"a"})",
        R"({"rave":2,"do":"stop","edit":{"remove_obstacle":"a"}})",
        R"({"rave":2,"do":"list","robot":"a"})",
        R"({"rave":2,"do":"hand_over","to":"real"})",
        R"({"rave":2,"do":"hand_over","robot":"a"})",
        R"({"rave":2,"do":"hand_over","robot":"a","to":1})",
        R"({"rave":2,"do":"reset_shadow","robot":7})",
        R"({"rave":2,"do":"stop","robot":"a\u0000b"})"}) {
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
