// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

/// Three robots of the teams `left` and `right`; `more` are keys of the scenario.
Result<ExpandedScenario> scenario_with(const std::string& more) {
  std::string robots;
  for (const auto& [name, team] :
       {std::pair("anna", "left"), {"ben", "right"}, {"cleo", "right"}}) {
    robots += fmt::format(
        "  - {{name: {}, team: {}, robot: {{body: {{shapes: [{{disc_radius_m: "
        "0.1, z_m: [0, 1]}}]}}}}}}\n",
        name, team);
  }
  return expand_scenario_text("name: a\nrobots:\n" + robots + more, "s.yaml");
}

std::string teams_of(const PlannedPerson& person) {
  if (!person.teams) return "*";
  std::string text;
  for (const std::string& team : *person.teams) text += team + " ";
  return text;
}

/// Each person with their teams.
std::string people_of(const std::string& more) {
  const auto scenario = scenario_with(more);
  if (!scenario) return scenario.error().text();
  std::string text;
  for (const PlannedPerson& person : plan_people(*scenario)) {
    text += person.name + ": " + teams_of(person) + "\n";
  }
  return text;
}

constexpr const char* kTeams =
    "teams:\n"
    "  - {name: all, commander: boss}\n"
    "  - {name: left, parent: all, leader: anna, commander: lea}\n"
    "  - {name: right, parent: all}\n"
    "  - {name: far, parent: right}\n";

TEST(People, CommandWhatNobodyBelowThemCommands) {
  EXPECT_EQ(people_of(std::string(kTeams) + "users:\n"
                                            "  - {name: boss, role: commander}\n"
                                            "  - {name: lea, role: commander}\n"
                                            "  - {name: idle, role: commander}\n"
                                            "  - {name: iris}\n"
                                            "  - {name: otto, teams: [right]}\n"
                                            "  - {name: sue, role: super_user}\n"),
            "boss: all far right \nlea: left \nidle: \niris: *\notto: far right \nsue: *\n");
}

TEST(People, WithoutTeamsHaveThoseOfRobots) {
  EXPECT_EQ(people_of("users:\n"
                      "  - {name: pupil, role: commander, teams: [left], pages: 2}\n"
                      "  - {name: carl, role: commander}\n"
                      "  - {name: none, pages: 0}\n"),
            "pupil-1: left \npupil-2: left \ncarl: *\n");
}

TEST(People, ErrorsNameTheirPlace) {
  const std::string users =
      "users: [{name: boss, role: commander}, {name: lea, role: commander}]\n";
  EXPECT_EQ(people_of("teams:\n  - {name: left, commander: mia}\n  - {name: right}\n" + users),
            "s.yaml:7:29: `commander`: there is no user `mia`; did you mean `lea`?");
  EXPECT_EQ(
      people_of("teams: [{name: left, commander: iris}, {name: right}]\nusers: [{name: iris}]\n"),
      "s.yaml:6:33: `commander`: the user `iris` is an observer; expected `role: commander`");
  EXPECT_EQ(
      people_of("teams: [{name: left}]\n"),
      "s.yaml:4:12: `team`: robot `ben` is of team `right`, which `teams` does not have; there "
      "are left\ns.yaml:5:12: `team`: robot `cleo` is of team `right`, which `teams` does not "
      "have; there are left");
  EXPECT_EQ(
      people_of(std::string(kTeams) +
                "users: [{name: boss, role: commander}, {name: lea, role: commander, teams: "
                "[far]}]\n"),
      "s.yaml:11:77: `teams`: team `far` has the commander `boss` (s.yaml:7:28); expected one "
      "commander");
  EXPECT_EQ(people_of("teams: [{name: left, parent: right}, {name: right, parent: left}]\n"),
            "s.yaml:6:30: `parent`: the team `left` is below itself by way of `right`");
  EXPECT_EQ(people_of("teams: [{name: left, leader: ben}, {name: right, leader: bob}]\n"),
            "s.yaml:6:30: `leader`: robot `ben` belongs to team `right`, not to `left`\n"
            "s.yaml:6:58: `leader`: there is no robot `bob`; did you mean `ben`?");
  EXPECT_EQ(people_of("users: [{name: iris, teams: [lift]}]\n"),
            "s.yaml:6:30: `teams`: there is no team `lift`; did you mean `left`?");
  EXPECT_EQ(people_of("teams: [{name: left, parent: rigth}, {name: right}]\n"),
            "s.yaml:6:30: `parent`: there is no team `rigth`; did you mean `right`?");
  EXPECT_EQ(people_of("users: [{name: iris}, {name: iris}]\n"),
            "s.yaml:6:30: two users are named `iris`; the first is at s.yaml:6:16");
}

TEST(People, AGiftNamesATeamAndACommanderOfTheScenario) {
  const auto error_of = [](const std::string& gift) {
    const auto scenario = scenario_with(
        "users: [{name: kim, role: commander}, {name: lee}]\n"
        "teams: [{name: all}, {name: left, parent: all}, {name: right, parent: all}]\n"
        "changes: [{at_s: 1, give: " +
        gift + "}]\n");
    return scenario ? "" : scenario.error().text();
  };
  EXPECT_EQ(error_of("{team: left, to: kim}"), "");
  EXPECT_NE(error_of("{team: lefd, to: kim}").find("no team `lefd`"), std::string::npos);
  EXPECT_NE(error_of("{team: left, to: kin}").find("no user `kin`"), std::string::npos);
  EXPECT_NE(error_of("{team: left, to: lee}").find("is an observer"), std::string::npos);
}

TEST(People, AGiftIsReadAsItIsTold) {
  const auto gift = TeamGift::parse(TeamGift::text("left", "kim to be"));
  ASSERT_TRUE(gift);
  EXPECT_EQ(*gift, std::pair(std::string("left"), std::string("kim to be")));
  for (const char* const bad : {"", "left", " to kim", "left to "}) {
    EXPECT_FALSE(TeamGift::parse(bad)) << bad;
  }
}

}  // namespace
}  // namespace rave::config
