// SPDX-License-Identifier: Apache-2.0
#include "page/page_message.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "rave/base/file.hpp"

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
  EXPECT_TRUE(look.variances.empty());
}

TEST(PageMessage, AcknowledgementsAreReadAlikeInEveryForm) {
  for (const char* const text :
       {R"({"type":"ack","sequence":4294967295})", R"({"sequence":4294967295,"type":"ack"})",
        R"( {"type": "ack", "sequence": 4294967295} )"}) {
    const auto message = parse_page_message(text);
    ASSERT_TRUE(message) << message.error().text();
    EXPECT_EQ(std::get<AckMessage>(*message).sequence, 4294967295U) << text;
  }
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

CommandMessage command_in(const char* text) {
  const auto message = parse_page_message(text);
  EXPECT_TRUE(message) << message.error().text();
  return message ? std::get<CommandMessage>(*message) : CommandMessage{};
}

TEST(PageMessage, RequestsAboutRunsAreRead) {
  const auto start =
      parse_page_message(R"({"type":"conduct","request":7,"do":"start","name":"flock","seed":3})");
  ASSERT_TRUE(start) << start.error().text();
  EXPECT_EQ(std::get<ConductMessage>(*start),
            (ConductMessage{ConductMessage::Do::kStart, 7, "flock", 3}));
  const auto end = parse_page_message(R"({"type":"conduct","request":8,"do":"end"})");
  ASSERT_TRUE(end) << end.error().text();
  EXPECT_EQ(std::get<ConductMessage>(*end).what, ConductMessage::Do::kEnd);
  for (const char* const text :
       {R"({"type":"conduct","request":1,"do":"start"})",
        R"({"type":"conduct","request":1,"do":"end","name":"flock"})",
        R"({"type":"conduct","request":1,"do":"open","name":"a","seed":1})",
        R"({"type":"conduct","request":1,"do":"restart","seed":-1})",
        R"({"type":"conduct","request":1,"do":"kill"})"}) {
    EXPECT_FALSE(parse_page_message(text)) << text;
  }
}

TEST(PageMessage, RequestsAboutPeopleAreRead) {
  const auto people = [](const char* text) {
    const auto message = parse_page_message(text);
    EXPECT_TRUE(message) << message.error().text();
    return message ? std::get<PeopleMessage>(*message) : PeopleMessage();
  };
  const auto change = std::get<AccountMessage>(people(
      R"({"type":"account","request":3,"do":"change","name":"ben","role":"commander","teams":"blue,green"})"));
  EXPECT_EQ(change.name, "ben");
  EXPECT_EQ(change.role, Role::kCommander);
  EXPECT_EQ(change.teams.text(), "blue,green");
  const auto made = std::get<InvitationMessage>(people(
      R"({"type":"invitation","request":4,"do":"make","role":"observer","teams":"*","uses":20,"days":2})"));
  EXPECT_TRUE(made.make);
  EXPECT_EQ(made.uses, 20U);
  const auto audit =
      std::get<AuditMessage>(people(R"({"type":"audit","request":5,"most":100,"what":"stop"})"));
  EXPECT_EQ(audit.filter.what, "stop");
  for (const auto& [text, expected] :
       {std::pair(R"({"type":"account","request":1,"do":"remove","name":"ben"})",
                  "`do`: expected change, disable, enable or end_sessions"),
        std::pair(R"({"type":"account","request":1,"do":"change","name":"ben","role":"root"})",
                  "`role`: expected observer, commander or super_user"),
        std::pair(R"({"type":"account","request":1,"do":"disable","name":"ben","role":"observer"})",
                  "the message has unknown members"),
        std::pair(R"({"type":"invitation","request":1,"do":"make","role":"observer","teams":",",)"
                  R"("uses":1,"days":1})",
                  "`teams`: expected teams such as green,blue, or * for all, or - for none"),
        std::pair(R"({"type":"invitation","request":1,"do":"make","role":"observer","teams":"*",)"
                  R"("uses":0,"days":1})",
                  "`uses`: expected 1 to 1000"),
        std::pair(R"({"type":"audit","request":1,"most":1001})", "`most`: expected 1 to 1000")}) {
    const auto message = parse_page_message(text);
    ASSERT_FALSE(message) << text;
    EXPECT_EQ(message.error().message, expected);
  }
}

TEST(PageMessage, OrdersAreRead) {
  const CommandMessage drive =
      command_in(R"({"type":"order","request":7,"kind":"drive","slots":[3],"v":0.2,"w":-1})");
  EXPECT_EQ(drive.action, request::Action(request::Drive{0.2, -1}));
  EXPECT_EQ(drive.request, 7U);
  EXPECT_EQ(drive.slots, (std::vector<std::uint32_t>{3}));
  EXPECT_FALSE(drive.stands());
  const CommandMessage goals = command_in(
      R"({"type":"order","request":1,"kind":"goal","slots":[1,2],"points":[[1,2],[3,4]],"yaw":1,"speed":0.5})");
  EXPECT_EQ(goals.points[1], (Vec2{3, 4}));
  EXPECT_EQ(goals.action_for(0), request::Action(request::Goal{{1, 2}, 1, 0.5}));
  EXPECT_EQ(goals.action_for(1), request::Action(request::Goal{{3, 4}, 1, 0.5}));
  EXPECT_EQ(command_in(R"({"type":"order","request":1,"kind":"text","slots":[1],"text":"go\nnow"})")
                .action,
            request::Action(request::Text{"go\nnow"}));
}

TEST(PageMessage, LeasesParametersAndObstaclesAreRead) {
  const CommandMessage take =
      command_in(R"({"type":"lease","request":1,"do":"force","slots":[0]})");
  EXPECT_EQ(take.action, request::Action(request::Take{.force = true}));
  EXPECT_EQ(command_in(R"({"type":"lease","request":1,"do":"give","slots":[0],"to":"ben"})").action,
            request::Action(request::Give{"ben"}));
  const CommandMessage set = command_in(
      R"({"type":"set","request":1,"slots":[0],"key":"program.cruise_mps","value":0.25})");
  EXPECT_EQ(set.action, request::Action(request::Set{"program.cruise_mps", "0.25"}));
  const auto edit_in = [](const std::string& rest) {
    const std::string text = R"({"type":"edit","request":1,"name":"pond",)" + rest + "}";
    return command_in(text.c_str()).as<request::Edit>()->edit;
  };
  config::ObstacleEdit pond;
  pond.add_obstacle.emplace().name = std::string("pond");
  pond.add_obstacle->x_m = 1;
  config::Outline& outline = pond.add_obstacle->outline;
  outline.disc_radius_m = 0.5;
  EXPECT_EQ(edit_in(R"("do":"add","pose":[1,0,0],"disc":0.5)"), pond);
  outline.disc_radius_m.reset();
  outline.polygon_m = std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 1}};
  EXPECT_EQ(edit_in(R"("do":"add","pose":[1,0,0],"polygon":[[0,0],[1,0],[0,1]])"), pond);
  const config::ObstacleEdit moved = edit_in(R"("do":"move","pose":[1,2,-0.5])");
  ASSERT_TRUE(moved.move_obstacle);
  EXPECT_EQ(moved.move_obstacle->y_m, 2);
  EXPECT_NEAR(moved.move_obstacle->yaw_deg, -28.65, 0.01);
  EXPECT_EQ(edit_in(R"("do":"remove")").remove_obstacle->value, "pond");
  const CommandMessage swap =
      command_in(R"({"type":"twin","request":1,"do":"hand_over","slots":[3],"to":"real"})");
  EXPECT_EQ(swap.action, request::Action(request::HandOver{"real"}));
  EXPECT_TRUE(command_in(R"({"type":"twin","request":1,"do":"reset_shadow","slots":[3]})")
                  .is<request::ResetShadow>());
}

TEST(PageMessage, ProbesAreReadWithTheirValuesAsAFileHasThem) {
  const auto message = parse_page_message(
      R"({"type":"look_probes","request":5,"probes":[{"slot":2,"name":"sonar_2","driver":"virtual_sonar","mount":[0.5,-1,3],"z":0.2,"params":{"cone_deg":12.5,"fast":true,"mode":"a, b","zones":[1,2]}}]})");
  ASSERT_TRUE(message.has_value()) << message.error().message;
  const auto& look = std::get<LookProbesMessage>(*message);
  EXPECT_EQ(look.request, 5U);
  ASSERT_EQ(look.probes.size(), 1U);
  const ProbeRequest& request = look.probes[0];
  EXPECT_EQ(request.slot, 2U);
  EXPECT_EQ(request.X_RS, (Pose2{0.5, -1, 3}));
  EXPECT_EQ(request.z_m, 0.2);
  const std::vector<std::pair<std::string, std::string>> params = {
      {"cone_deg", "12.5"}, {"fast", "true"}, {"mode", "\"a, b\""}, {"zones", "[1,2]"}};
  EXPECT_EQ(request.params, params);
}

TEST(PageMessage, WhatIsSaidIsRead) {
  const auto message = parse_page_message(
      R"({"type":"say","request":3,"to":"robot","slot":2,"text":"Where are you?"})");
  ASSERT_TRUE(message) << message.error().text();
  EXPECT_EQ(std::get<ChatMessage>(*message).to, ChatMessage::To::kRobot);
  EXPECT_EQ(std::get<ChatMessage>(*message).slot, 2U);
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
        Refused{R"({"type":"ack","sequence":01})", "expected a JSON object"},
        Refused{R"({"type":"ack","sequence":})", "expected a JSON object"},
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
        Refused{R"({"type":"order","request":1,"kind":"fly","slots":[0]})", "expected drive"},
        Refused{R"({"type":"order","kind":"cancel","slots":[0]})", "`request` is missing"},
        Refused{R"({"type":"order","request":1,"kind":"cancel","slots":[]})", "each once"},
        Refused{R"({"type":"order","request":1,"kind":"cancel","slots":[1,1]})", "each once"},
        Refused{R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":null,"w":0})",
                "finite number"},
        Refused{R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1e9,"w":0})",
                "from -100 to 100"},
        Refused{R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":NaN,"w":0})",
                "JSON object"},
        Refused{R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[1]]})",
                "pairs"},
        Refused{R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[1,2e7]]})",
                "pairs"},
        Refused{
            R"({"type":"order","request":1,"kind":"goal","slots":[0,1,2],"points":[[1,2],[3,4]]})",
            "one for each robot, 3"},
        Refused{R"({"type":"order","request":1,"kind":"place","slots":[0,1],"points":[[1,2]]})",
                "one for each robot, 2"},
        Refused{
            R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[1,2]],"yaw":7})",
            "`yaw`"},
        Refused{
            R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[1,2]],"speed":-1})",
            "`speed`"},
        Refused{R"({"type":"order","request":1,"kind":"path","slots":[0],"points":[[1,2]]})",
                "2 to 1000"},
        Refused{R"({"type":"order","request":1,"kind":"text","slots":[0],"text":"a\u0007"})",
                "1000 bytes"},
        Refused{R"({"type":"lease","request":1,"do":"steal","slots":[0]})", "take, force or give"},
        Refused{R"({"type":"set","request":1,"slots":[0],"key":"a","value":[1]})", "`value`"},
        Refused{
            R"({"type":"edit","request":1,"do":"add","name":"a\", x: 1","pose":[0,0,0],"disc":1})",
            "letters, digits"},
        Refused{R"({"type":"edit","request":1,"do":"add","name":"a","pose":[0,0],"disc":1})",
                "`pose`"},
        Refused{
            R"({"type":"edit","request":1,"do":"add","name":"a","pose":[0,0,0],"polygon":[[0,0],[1,1]]})",
            "3 to 64 corners"},
        Refused{R"({"type":"say","request":1,"to":"everybody","text":"a"})", "expected all"},
        Refused{R"({"type":"say","request":1,"to":"all","text":" "})", "a text that is not empty"},
        Refused{R"({"type":"say","request":1,"to":"role","name":"king","text":"a"})", "observer"},
        Refused{R"({"type":"look_probes","request":1,"probes":[1]})", "expected objects"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a b","driver":"d","mount":[0,0,0],"z":0,"params":{}}]})",
            "`name`: expected letters"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a","driver":"d","mount":[0,0],"z":0,"params":{}}]})",
            "`mount`"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a","driver":"d","mount":[0,0,0],"z":1e9,"params":{}}]})",
            "`z`: expected a number from -100 to 100"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a","driver":"d","mount":[0,0,0],"z":0,"params":{"x":{"y":1}}}]})",
            "`params.x`"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a","driver":"d","mount":[0,0,0],"z":0,"params":{"x: 1, y":1}}]})",
            "plain names"},
        Refused{
            R"({"type":"look_probes","request":1,"probes":[{"slot":0,"name":"a","driver":"d","mount":[0,0,0],"z":0,"params":{},"device":"base"}]})",
            "unknown members"},
        Refused{R"({"type":"twin","request":1,"do":"swap","slots":[0]})",
                "hand_over or reset_shadow"},
        Refused{R"({"type":"twin","request":1,"do":"hand_over","slots":[0],"to":"here"})",
                "real, simulated, first or twin"},
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
            "pairs"},
        Refused{
            R"({"type":"look","poses":true,"true_poses":false,"parts":true,"max_hz":9,"readings":[],"variances":[-1]})",
            "`variances`: expected a whole number"},
        Refused{
            R"({"type":"look","poses":true,"true_poses":false,"parts":true,"max_hz":9,"readings":[],"courses":[7]})",
            "`courses`: expected pairs of slot and sensor"}));

TEST(PageMessage, VariancesAreLookedAtByRobotWhateverReadingsAre) {
  const auto message = parse_page_message(
      R"({"type":"look","poses":true,"true_poses":false,"parts":false,"max_hz":25,"readings":[],"courses":[[1,2],[1,2]],"variances":[7,2,7]})");
  ASSERT_TRUE(message) << message.error().text();
  EXPECT_EQ(std::get<LookMessage>(*message).variances, (std::vector<std::uint32_t>{2, 7}));
  EXPECT_EQ(std::get<LookMessage>(*message).courses, (std::vector<LookedAt>{{1, 2}}));
}

TEST(PageMessage, MapsAreLookedAtBySlotOrName) {
  const auto message = parse_page_message(R"({"type":"look_maps","maps":["world file",7,0,7]})");
  ASSERT_TRUE(message) << message.error().message;
  EXPECT_EQ(std::get<LookMapsMessage>(*message).maps,
            (std::vector<MapName>{{0, ""}, {7, ""}, {maps::kNoRobot, "world file"}}));
  const auto error_of = [](const char* maps) {
    const auto refused =
        parse_page_message(std::string(R"({"type":"look_maps","maps":)") + maps + "}");
    return refused ? "accepted" : refused.error().message;
  };
  EXPECT_EQ(error_of("[0,1,2,3,4]"), "`maps`: expected an array of at most 4");
  EXPECT_EQ(error_of("[-1]"), "`maps`: expected a whole number from 0 to 4294967295");
  EXPECT_EQ(error_of("[4294967295]"), "`maps`: there is no such slot");
  EXPECT_EQ(error_of("[\"\"]"), "`maps`: expected names of 1 to 64 bytes");
  EXPECT_EQ(error_of("3"), "`maps`: expected an array of at most 4");
}

TEST(PageMessage, APathHasAThousandPointsAndNoMore) {
  const auto path = [](int points) {
    std::string text = R"({"type":"order","request":1,"kind":"path","slots":[0],"points":[)";
    for (int i = 0; i < points; ++i) text += i == 0 ? "[0,1]" : ",[0,1]";
    return parse_page_message(text + "]}");
  };
  EXPECT_TRUE(path(1000));
  ASSERT_FALSE(path(10'000));
  EXPECT_NE(path(10'000).error().message.find("10000 points; expected 2 to 1000"),
            std::string::npos);
}

// A fuzzer that begins with messages nobody accepts hardly comes past the first check.
TEST(PageMessage, SeedsOfTheFuzzerAreOfEveryKind) {
  std::set<std::size_t> kinds;
  for (const auto& file : std::filesystem::directory_iterator(
           RAVE_SOURCE_DIR "/servers/gui_server/tests/corpus_page")) {
    const auto text = read_file(file.path());
    ASSERT_TRUE(text) << text.error().text();
    const auto message = parse_page_message(*text);
    ASSERT_TRUE(message) << file.path() << ": " << message.error().text();
    kinds.insert(message->index());
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<PageMessage>);
}

}  // namespace
}  // namespace rave::gui_server
