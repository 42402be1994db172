// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/rights.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "rave/base/file.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/host/host_run.hpp"
#include "rights/scenario_rights.hpp"
#include "visitors/rights_desk.hpp"
#include "visitors/view.hpp"

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;
using Kind = Reach::Kind;
using RightsJson = nlohmann::json;

const Teams kGreen{false, {"green"}};

std::string roster() {
  RightsJson robots = RightsJson::array();
  for (const auto& [name, team] : {std::pair("walker-1", "green"), std::pair("spy-2", "blue"),
                                   std::pair("walker-3", "green"), std::pair("spy-20", "blue")}) {
    robots.push_back(
        {{"name", name},
         {"team", team},
         {"sensors", RightsJson::array({{{"name", "scan"}, {"kind", "ranges"}},
                                        {{"name", "others"}, {"kind", "neighbours"}}})}});
  }
  return robots.dump();
}

const char* const kBodies =
    R"([{"id":0,"name":"pond","kind":"virtual"},{"id":1,"name":"hall","kind":"wall"}])";

std::shared_ptr<const Cast> cast() {
  return std::make_shared<const Cast>(cast_of(roster(), kBodies));
}

/// What an observer of team green gets who sees their own team alone.
View own_team_view() {
  Rights rights;
  EXPECT_TRUE(rights.set(Role::kObserver, InfoClass::kPose, {Kind::kOwn, {}}));
  EXPECT_TRUE(rights.set(Role::kObserver, InfoClass::kObstacles, {Kind::kNone, {}}));
  return {rights, {"ben", Role::kObserver, kGreen}, cast()};
}

TEST(UsualRights, GrowWithTheRole) {
  const Rights rights;
  for (std::size_t i = 0; i < kInfoClasses; ++i) {
    const auto what = static_cast<InfoClass>(i);
    EXPECT_EQ(class_named(to_string(what)), what);
    for (const auto& [low, high] : {std::pair(Role::kObserver, Role::kCommander),
                                    std::pair(Role::kCommander, Role::kSuperUser)}) {
      for (const char* const team : {"green", "blue"}) {
        EXPECT_LE(rights.of(low, what).covers(team, kGreen),
                  rights.of(high, what).covers(team, kGreen))
            << to_string(what);
      }
    }
  }
}

TEST(UsualRights, AreThoseOfTheDocumentation) {
  const auto page = read_file(fs::path(RAVE_SOURCE_DIR) / "docs/how-to/share-the-page.md");
  ASSERT_TRUE(page) << page.error().text();
  EXPECT_NE(page->find(Rights::usual_table()), std::string::npos) << Rights::usual_table();
}

TEST(RightsOfAPerson, AreTheirOwnBeforeThoseOfTheRole) {
  Rights rights;
  const Person ben{"ben", Role::kObserver, kGreen, true};
  rights.set_user("ben", InfoClass::kRecording, Reach{Kind::kAll, {}});
  EXPECT_EQ(rights.of(ben, InfoClass::kRecording).kind, Kind::kAll);
  // An invited person who chose that name is somebody else.
  EXPECT_EQ(rights.of({"ben", Role::kObserver, kGreen}, InfoClass::kRecording).kind, Kind::kNone);
  rights.set_user("ben", InfoClass::kRecording, std::nullopt);
  EXPECT_EQ(rights.of(ben, InfoClass::kRecording).kind, Kind::kNone);
  EXPECT_FALSE(rights.set(Role::kSuperUser, InfoClass::kPose, {}));
  rights.set_user("root", InfoClass::kPose, Reach{Kind::kNone, {}});
  EXPECT_EQ(rights.of({"root", Role::kSuperUser, {}}, InfoClass::kPose).kind, Kind::kAll);
}

TEST(RightsOfAScenario, ChangeTheUsualOnes) {
  config::GuiFile gui;
  gui.rights.push_back({config::GuiRole::kObserver,
                        {},
                        {config::GuiClass::kPose, config::GuiClass::kReadings},
                        config::GuiReach::kTeams,
                        {std::string("green")}});
  gui.rights.push_back({{},
                        codec::Located<std::string>("eve"),
                        {config::GuiClass::kStop},
                        config::GuiReach::kAll,
                        {}});
  const Rights rights = rights_of(gui);
  EXPECT_EQ(rights.of(Role::kObserver, InfoClass::kReadings), (Reach{Kind::kTeams, {"green"}}));
  EXPECT_EQ(rights.of(Role::kCommander, InfoClass::kPose).kind, Kind::kAll);
  EXPECT_EQ(rights.of({"eve", Role::kObserver, {}, true}, InfoClass::kStop).kind, Kind::kAll);
}

TEST(RightsOfAScenario, AreNoPartOfWhatProcessesCompare) {
  config::ExpandedScenario plain;
  plain.scenario.name = codec::Located<std::string>("a");
  config::ExpandedScenario shared = plain;
  shared.scenario.gui.rights.push_back(
      {config::GuiRole::kObserver, {}, {config::GuiClass::kPose}, config::GuiReach::kNone, {}});
  EXPECT_EQ(runtime::shared_number(plain), runtime::shared_number(shared));
  // But recordings have it, so that a replay applies it.
  EXPECT_NE(config::write_expanded(shared).find("role: observer"), std::string::npos);
}

TEST(RightsOfAScenario, HaveTheClassesOfTheTable) {
  const auto schema = read_file(fs::path(RAVE_SOURCE_DIR) / "schemas/config/scenario.schema.json");
  ASSERT_TRUE(schema);
  RightsJson names = RightsJson::array();
  for (std::size_t i = 0; i < kInfoClasses; ++i) {
    names.push_back(to_string(static_cast<InfoClass>(i)));
  }
  std::string text;
  for (const char c : *schema) {
    if (c != ' ' && c != '\n') text.push_back(c);
  }
  EXPECT_NE(text.find(names.dump()), std::string::npos) << names.dump();
}

TEST(ViewOfARun, HasSlotsWithoutGapsForWhoIsSeen) {
  const View view = own_team_view();
  EXPECT_FALSE(view.whole());
  EXPECT_EQ(view.robots(), 2U);
  EXPECT_EQ(view.robot_of(1), 2U);
  EXPECT_EQ(view.robot_of(2), std::nullopt);
  EXPECT_EQ(view.slot_of(1), std::nullopt);
  EXPECT_EQ(view.slot_of(2), 1U);
  const RightsJson robots = RightsJson::parse(view.robots_json(roster()));
  ASSERT_EQ(robots.size(), 2U);
  EXPECT_EQ(robots[1]["name"], "walker-3");
  EXPECT_EQ(view.robots_json(roster()).find("spy"), std::string::npos);
}

TEST(ViewOfARun, SaysWhichRobotsItsPersonMayNotStop) {
  Rights rights;
  const Person ben{"ben", Role::kCommander, kGreen};
  ASSERT_TRUE(rights.set(Role::kCommander, InfoClass::kStop, {Kind::kOwn, {}}));
  const RightsJson robots = RightsJson::parse(View(rights, ben, cast()).robots_json(roster()));
  ASSERT_EQ(robots.size(), 4U);
  EXPECT_FALSE(robots[0].contains("stoppable"));
  EXPECT_EQ(robots[1]["stoppable"], false);
  // Who may stop nobody is not told of each robot.
  ASSERT_TRUE(rights.set(Role::kCommander, InfoClass::kStop, {Kind::kNone, {}}));
  EXPECT_EQ(View(rights, ben, cast()).robots_json(roster()).find("stoppable"), std::string::npos);
}

TEST(ViewOfARun, CutsPosesDown) {
  PosesAt all;
  for (int i = 0; i < 4; ++i) all.robots.push_back({double(i), 0, 0, 0, kKnown});
  all.truth = all.robots;
  const PosesAt mine = own_team_view().poses(all);
  ASSERT_EQ(mine.robots.size(), 2U);
  EXPECT_EQ(mine.robots[1].x_m, 2);
  // Observers are not told where robots really are.
  EXPECT_TRUE(mine.truth.empty());
}

TEST(ViewOfARun, HasTruePosesOfThoseTeamsAlone) {
  Rights rights;
  ASSERT_TRUE(rights.set(Role::kObserver, InfoClass::kTruePose, {Reach::Kind::kOwn, {}}));
  const auto cast = std::make_shared<const Cast>(cast_of(roster(), kBodies));
  const View view(rights, {"eve", Role::kObserver, {false, {"green"}}}, cast);
  PosesAt all;
  for (int i = 0; i < 4; ++i) all.robots.push_back({double(i), 0, 0, 0, kKnown});
  EXPECT_TRUE(view.poses(all).truth.empty()) << "nobody asked";
  all.truth = all.robots;
  const PosesAt mine = view.poses(all);
  // All are seen, and two belong to team green.
  ASSERT_EQ(mine.robots.size(), 4U);
  ASSERT_EQ(mine.truth.size(), 4U);
  for (std::uint32_t slot = 0; slot < 4; ++slot) {
    const bool own = slot % 2 == 0;
    EXPECT_EQ(mine.truth[slot].flags, own ? kKnown : 0) << slot;
    EXPECT_EQ(mine.truth[slot].x_m, own ? slot : 0) << slot;
  }
}

TEST(ViewOfARun, WithholdsReadingsAndHalvesAndRowsAboutOthers) {
  const View view = own_team_view();
  ReadingAt reading;
  reading.slot = 1;
  EXPECT_FALSE(view.reading(reading));
  reading.slot = 2;
  reading.part = 1;
  EXPECT_FALSE(view.reading(reading));
  reading = {2, 1, 0, 0, 3, 2, {0, 0.5F, 1, 0.6F, 3, 0.7F}};
  ASSERT_TRUE(view.reading(reading));
  EXPECT_EQ(reading.slot, 1U);
  EXPECT_EQ(reading.rows, 1U);
  EXPECT_EQ(reading.values, (std::vector<float>{0, 0.5F}));
}

TEST(ViewOfARun, WithholdsEventsThatNameTheUnseen) {
  const View view = own_team_view();
  const auto shown = [&view](const char* text, std::vector<std::uint32_t> slots) {
    LogEvent event;
    event.text = text;
    event.slots = std::move(slots);
    return view.event(event).has_value();
  };
  EXPECT_TRUE(shown("walker-1 and walker-3 touch", {0, 2}));
  EXPECT_FALSE(shown("walker-1 and spy-2 touch", {0, 1}));
  EXPECT_FALSE(shown("walker-1: guard stopped, spy-20 came near", {0}));
  EXPECT_TRUE(shown("walker-1: spy-2000 is somebody else", {0}));
  EXPECT_FALSE(shown("obstacle `pond` added", {}));
  // One that came later has a name that is not known here.
  EXPECT_FALSE(shown("obstacle `pond-2` added", {}));
  EXPECT_TRUE(shown("the run is late", {}));
  LogEvent event;
  event.slots = {2};
  EXPECT_EQ(view.event(event)->slots, (std::vector<std::uint32_t>{1}));
  LogEvent left_out;
  left_out.kind = "contact";
  left_out.text = "7 more in this step";
  EXPECT_FALSE(view.event(left_out)) << "it counts the contacts of withheld robots";
}

TEST(ViewOfARun, WithoutTheLogHasNoEvents) {
  const auto seen_with = [](const Reach& reach, std::vector<std::uint32_t> slots) {
    Rights rights;
    EXPECT_TRUE(rights.set(Role::kObserver, InfoClass::kLog, reach));
    LogEvent event;
    event.text = "something happens";
    event.slots = std::move(slots);
    return View{rights, {"ben", Role::kObserver, kGreen}, cast()}.event(event).has_value();
  };
  EXPECT_TRUE(seen_with({Kind::kAll, {}}, {0}));
  EXPECT_TRUE(seen_with({Kind::kOwn, {}}, {0}));
  EXPECT_FALSE(seen_with({Kind::kOwn, {}}, {1}));
  EXPECT_TRUE(seen_with({Kind::kOwn, {}}, {})) << "the run itself";
  EXPECT_FALSE(seen_with({Kind::kNone, {}}, {0}));
  EXPECT_FALSE(seen_with({Kind::kNone, {}}, {}));
}

TEST(ViewOfARun, WithholdsWhatIsSaidToRobotsOfOthersAndWhereTheyAreSent) {
  const View view{Rights(), {"ben", Role::kCommander, kGreen}, cast()};
  const auto shown = [&view](const char* kind, const char* text, std::uint32_t robot) {
    LogEvent event;
    event.kind = kind;
    event.text = text;
    event.slots = {robot};
    return view.event(event).has_value();
  };
  EXPECT_TRUE(shown("said", "walker-1: said, here", 0));
  EXPECT_FALSE(shown("said", "spy-2: said, here", 1));
  EXPECT_TRUE(shown("ordered", "walker-1: ordered, text: Where are you? (by hand: ben)", 0));
  EXPECT_FALSE(shown("ordered", "spy-2: ordered, text: Where are you? (by hand: eve)", 1));
  EXPECT_FALSE(shown("ordered", "spy-2: ordered, goal 1.00, 2.00 (by hand: eve)", 1));
  // The rest of the log tells of all who are seen.
  EXPECT_TRUE(shown("lease", "spy-2: lease, eve drives", 1));
  Rights rights;
  ASSERT_TRUE(rights.set(Role::kCommander, InfoClass::kGoals, {Kind::kAll, {}}));
  const View goals{rights, {"ben", Role::kCommander, kGreen}, cast()};
  LogEvent event{};
  event.kind = "ordered";
  event.slots = {1};
  event.text = "spy-2: ordered, goal 1.00, 2.00 (by hand: eve)";
  EXPECT_TRUE(goals.event(event));
  event.text = "spy-2: ordered, text: Where are you? (by hand: eve)";
  EXPECT_FALSE(goals.event(event));
}

TEST(ViewOfARun, WithholdsVirtualObstaclesAndHowManyThereAre) {
  const View view = own_team_view();
  const RightsJson bodies = RightsJson::parse(view.bodies_json(kBodies));
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0]["name"], "hall");
  EXPECT_NE(bodies[0]["id"], 1);
  EXPECT_EQ(bodies[0]["id"], view.body_id(1));
  EXPECT_EQ(view.bodies_json(kBodies).find("pond"), std::string::npos);
}

TEST(ViewOfARun, OfASuperUserIsWhole) {
  const View view({}, {"root", Role::kSuperUser, {}}, cast());
  EXPECT_TRUE(view.whole());
  EXPECT_EQ(view.robots_json(roster()), roster());
  EXPECT_EQ(view.bodies_json(kBodies), kBodies);
  EXPECT_TRUE(view.may_all(InfoClass::kRecording));
}

class DeskTest : public testing::Test {
 public:
  DeskTest() {
    std::string name = fs::temp_directory_path() / "rave-rights-XXXXXX";
    if (::mkdtemp(name.data()) != nullptr) folder_ = name;
  }
  ~DeskTest() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

 protected:
  RightsDesk opened(const std::string& run = "run") {
    auto desk = RightsDesk::open(folder_);
    EXPECT_TRUE(desk) << desk.error().text();
    desk->begin(run, {}, cast());
    return *std::move(desk);
  }
  fs::path folder_;
  const Person ben_{"ben", Role::kObserver, kGreen, true};
};

TEST_F(DeskTest, PeopleWithEqualRightsShareAView) {
  RightsDesk desk = opened();
  const auto ben = desk.view_of(ben_);
  EXPECT_EQ(desk.view_of({"cleo", Role::kObserver, kGreen}), ben);
  EXPECT_NE(desk.view_of({"dora", Role::kObserver, {false, {"blue"}}}), ben);
  const auto before = desk.revision();
  ASSERT_TRUE(desk.change({Role::kObserver, {}, InfoClass::kReadings, Reach{}}));
  EXPECT_NE(desk.revision(), before);
  EXPECT_TRUE(ben->may_any(InfoClass::kReadings));
  EXPECT_FALSE(desk.view_of(ben_)->may_any(InfoClass::kReadings));
}

TEST_F(DeskTest, ChangesOutliveTheServerForTheirRunAlone) {
  {
    RightsDesk desk = opened();
    ASSERT_TRUE(desk.change({Role::kObserver, {}, InfoClass::kPose, Reach{Kind::kOwn, {}}}));
    ASSERT_TRUE(desk.change({{}, "ben", InfoClass::kLog, Reach{Kind::kTeams, {"green", "red"}}}));
    ASSERT_TRUE(desk.change({Role::kCommander, {}, InfoClass::kStop, Reach{}}));
    ASSERT_TRUE(desk.change({Role::kCommander, {}, InfoClass::kStop, {}}));
  }
  RightsDesk desk = opened();
  EXPECT_EQ(desk.view_of(ben_)->robots(), 2U);
  EXPECT_EQ(desk.rights().of(ben_, InfoClass::kLog).kind, Kind::kTeams);
  EXPECT_EQ(desk.rights().of(Role::kCommander, InfoClass::kStop).kind, Kind::kAll);
  EXPECT_EQ(opened("another").view_of(ben_)->robots(), 4U);
}

TEST_F(DeskTest, WhatCannotBeIsRefusedAndChangesNothing) {
  RightsDesk desk = opened();
  const auto before = desk.revision();
  EXPECT_FALSE(desk.change({Role::kSuperUser, {}, InfoClass::kPose, Reach{}}));
  EXPECT_FALSE(desk.change({{}, "a\tb", InfoClass::kPose, Reach{}}));
  EXPECT_FALSE(
      desk.change({Role::kObserver, {}, InfoClass::kPose, Reach{Kind::kTeams, {"green\nrave"}}}));
  EXPECT_EQ(desk.revision(), before);
}

TEST_F(DeskTest, TellsTheTable) {
  RightsDesk desk = opened();
  ASSERT_TRUE(desk.change({{}, "ben", InfoClass::kLog, Reach{Kind::kTeams, {"green"}}}));
  const RightsJson message = RightsJson::parse(desk.message({ben_}));
  EXPECT_EQ(message["classes"].size(), kInfoClasses);
  EXPECT_EQ(message["teams"], RightsJson::parse(R"(["blue","green"])"));
  EXPECT_EQ(message["rows"][0]["cells"]["readings"], "own");
  EXPECT_EQ(message["rows"][3], RightsJson::parse(R"({"user":"ben","cells":{"log":["green"]}})"));
  EXPECT_EQ(message["people"][0]["teams"], "green");
}

TEST(RightsFile, IsStrict) {
  const auto error = [](const char* line) {
    const auto parsed = parse_rights(std::string("rave-rights 1\n") + line + "\n", "rights");
    return parsed ? "none" : parsed.error().text();
  };
  EXPECT_EQ(error("run\trole\tobserver\tpose\town"), "none");
  EXPECT_EQ(error("run\trole\tsuper_user\tpose\town"), "rights:2: expected observer or commander");
  EXPECT_EQ(error("run\tteam\tx\tpose\town"), "rights:2: expected role or user, with a name");
  EXPECT_EQ(error("run\tuser\tben\tposes\town"), "rights:2: expected a class, such as readings");
  EXPECT_EQ(error("run\tuser\tben\tpose\tteams:*"),
            "rights:2: expected none, own, all, usual or teams:green,blue");
  EXPECT_EQ(error("run\tuser\tben"), "rights:2: expected 5 columns, separated by tabs, found 3");
  EXPECT_FALSE(parse_rights("", "rights"));
}

}  // namespace
}  // namespace rave::gui_server
