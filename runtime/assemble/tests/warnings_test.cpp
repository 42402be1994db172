// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/warnings.hpp"

#include "rave/assemble_testing/host_fixture.hpp"

namespace rave::runtime::testing {
namespace {

std::vector<std::string> warnings(const std::string& text) {
  Host host;
  const auto scenario = config::expand_scenario_text(text, "s.yaml");
  EXPECT_TRUE(scenario.has_value()) << scenario.error().text();
  const auto built = host.build_text(text);
  EXPECT_TRUE(built.has_value()) << built.error().text();
  std::vector<std::string> texts;
  for (const Error& warning : warnings_of(*scenario, *built)) texts.push_back(warning.text());
  return texts;
}

const std::string kProgram = ", program: {driver: wander}";

/// A robot with a laser in a room with a pillar.
std::string room(const std::string& rest, const std::string& laser_m = "0.1",
                 const std::string& program = kProgram, const std::string& body = kBody) {
  return "name: s\nduration_s: 10\n" + rest +
         "obstacles: [{name: pillar, disc_radius_m: 0.5, x_m: 3, y_m: 1, z_m: [0, 0.8]},\n"
         "  {name: wall, box_m: [4, 0.2], x_m: -30, yaw_deg: 90, z_m: [0, 0.4]}]\n"
         "robots:\n  - name: anna\n    team: red\n    pose: {x_m: 0, y_m: 0}\n    robot: {" +
         body + ", sensors: [{name: laser, driver: virtual_laser, mount: {z_m: " + laser_m +
         "}}], " + kWheels + program + "}\n";
}

using Texts = std::vector<std::string>;

TEST(Warnings, AreNoneOfAUsualScenario) {
  EXPECT_EQ(warnings(room("checks: {arrivals: [{robot: anna, x_m: 2, y_m: 1, before_s: 10}]}\n"
                          "changes: [{at_s: 9.99, robot: anna, set: {body.scale: 1.1}}]\n"
                          "gui: {rights: [{role: observer, classes: [pose], reach: teams, teams: "
                          "[red]}]}\n")),
            Texts{});
}

TEST(Warnings, NameTargetsInsideObstaclesAndAfterTheEnd) {
  EXPECT_EQ(
      warnings(room("checks: {arrivals: [{robot: anna, x_m: 3.4, y_m: 1, before_s: 11},\n"
                    "  {robot: anna, x_m: -30, y_m: 1.9}, {robot: anna, x_m: -28.1, y_m: 0}]}\n")),
      (Texts{"s.yaml:3:29: the target (3.4, 1) of `anna` is inside the obstacle `pillar`",
             "s.yaml:3:29: `before_s`: 11 s is after the end of the run (10 s)",
             "s.yaml:4:11: the target (-30, 1.9) of `anna` is inside the obstacle `wall`"}));
}

TEST(Warnings, NameChangesAfterTheEnd) {
  EXPECT_EQ(warnings(room("changes: [{at_s: 10, robot: anna, set: {body.scale: 1.1}}]\n")),
            Texts{"s.yaml:3:18: the change at 10 s never happens: the run ends at 10 s"});
}

TEST(Warnings, NameTeamsWithoutRobots) {
  EXPECT_EQ(warnings(room("gui: {rights: [{role: observer, classes: [pose], reach: teams, teams: "
                          "[red, rad]}]}\n")),
            Texts{"s.yaml:3:77: no robot is of the team `rad`; did you mean `red`?"});
}

TEST(Warnings, NameSensorsAboveEverything) {
  EXPECT_EQ(warnings(room("", "0.8")), Texts{});
  const Texts high = warnings(room("", "0.9"));
  ASSERT_EQ(high.size(), 1U);
  EXPECT_NE(high[0].find(": sensor `laser` at 0.9 m is above everything: the highest other body "
                         "ends at 0.8 m"),
            std::string::npos)
      << high[0];
}

TEST(Warnings, NameHugeBodiesAndRobotsWithoutAProgram) {
  const Texts none = warnings(room("", "0.1", ""));
  EXPECT_EQ(none, Texts{"s.yaml:6:11: robot `anna` has controllers but no `program`: it stands "
                        "until a person drives it"});
  const std::string huge =
      "body: {shapes: [{box_m: [0.3, 150], centre_m: [-0.1, 200], z_m: [0, "
      "0.2]}]}";
  const Texts big = warnings(room("", "0.1", kProgram, huge));
  ASSERT_EQ(big.size(), 1U);
  EXPECT_NE(big[0].find("s.yaml:9:19: the body of `anna` reaches 275"), std::string::npos)
      << big[0];
}

}  // namespace
}  // namespace rave::runtime::testing
