// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "rave/config/expanded_scenario.hpp"
#include "rave/config/map_image.hpp"

namespace rave::config {
namespace {

const std::filesystem::path kData = RAVE_SOURCE_DIR "/libs/config/tests/data";

std::string error_of(std::string_view text) {
  const auto expanded = expand_scenario_text(text, kData / "scenarios/s.yaml");
  if (expanded) return "none";
  // Without the folder of the checkout, which differs from machine to machine.
  std::string all = expanded.error().text();
  const std::string folder = kData.string() + "/";
  for (auto at = all.find(folder); at != std::string::npos; at = all.find(folder)) {
    all.erase(at, folder.size());
  }
  return all;
}

#define WALKER "robots: [{name: w, file: ../robots/walker.yaml}]\n"

TEST(Expand, PutsFilesTogether) {
  const auto expanded = expand_scenario(kData / "scenarios/mixed.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  std::vector<std::string> names;
  for (const ExpandedRobot& robot : expanded->robots) names.push_back(robot.name);
  EXPECT_EQ(names, (std::vector<std::string>{"one", "two", "walker-1", "walker-2", "loner",
                                             "prey-1", "prey-2", "prey-3"}));
  EXPECT_EQ(expanded->groups.size(), 5U);
  const auto group = [&](std::size_t i) { return expanded->group_of(expanded->robots[i]); };
  EXPECT_EQ(group(0).robot.body->barcode, 5);
  EXPECT_EQ(group(1).robot.body->barcode, 14);
  EXPECT_EQ(group(4).robot.sensors[0].params.find("range_m")->as_double(), 2.5);
  EXPECT_EQ(group(2).team, "green");
  EXPECT_EQ(group(7).kind, "prey");
  EXPECT_EQ(group(7).scatter->count, 3);
  EXPECT_EQ(expanded->robots[3].pose, (PoseFile{1, 0.5, -90}));
  EXPECT_FALSE(expanded->robots[0].pose.has_value());
  EXPECT_FALSE(expanded->robots[7].pose.has_value());
  EXPECT_EQ(group(0).file, (kData / "robots/recorded.yaml").string());
  ASSERT_EQ(expanded->world.obstacles.size(), 3U);
  EXPECT_EQ(*expanded->world.obstacles[2].name, "box-1");
  EXPECT_EQ(*expanded->world.maps.at(0).file, (kData / "maps/lab.yaml").string());
  EXPECT_EQ(expanded->scenario.pace.factor, 10);
  EXPECT_FALSE(expanded->scenario.world.has_value());
}

TEST(Expand, MapsAreReadOnceAndThoseGivenAreNotLookedForOnTheDisk) {
  const auto expanded = expand_scenario(kData / "scenarios/mixed.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  const std::string yaml = (kData / "maps/lab.yaml").string();
  const std::string image = (kData / "maps/lab.pgm").string();
  ASSERT_TRUE(expanded->files.all().contains(yaml));
  ASSERT_TRUE(expanded->files.all().contains(image));

  std::string text = write_expanded(*expanded);
  for (auto at = text.find(yaml); at != std::string::npos; at = text.find(yaml)) {
    text.replace(at, yaml.size(), "/nowhere/lab.yaml");
  }
  EXPECT_FALSE(expand_scenario_text(text, "/again.yaml"));
  InputFiles given;
  given.add("/nowhere/lab.yaml", expanded->files.all().at(yaml));
  given.add("/nowhere/x/../lab.pgm", expanded->files.all().at(image));
  const auto again = expand_scenario_text(text, "/again.yaml", given);
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(again->files, given);
  EXPECT_TRUE(read_map("/nowhere/lab.yaml", again->files));
}

TEST(Expand, ATildeIsTheHomeFolder) {
  const std::string before = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  ::setenv("HOME", kData.c_str(), 1);
  const auto expanded = expand_scenario_text(
      "name: a\nmaps: [{file: ~/maps/lab.yaml, z_m: [0, 1]}]\nrobots:\n"
      "  - {name: w, file: ~/robots/walker.yaml}\n",
      "/elsewhere/s.yaml");
  ::setenv("HOME", before.c_str(), 1);
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_EQ(*expanded->world.maps.at(0).file, (kData / "maps/lab.yaml").string());
  EXPECT_EQ(expanded->groups.at(0).file, (kData / "robots/walker.yaml").string());
}

TEST(Expand, WhatIsWrittenExpandsToTheSameAnywhere) {
  for (const char* name : {"mixed", "small"}) {
    const auto expanded = expand_scenario(kData / "scenarios" / (std::string(name) + ".yaml"));
    ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
    const std::string text = write_expanded(*expanded);
    const auto again = expand_scenario_text(text, "/elsewhere/again.yaml");
    ASSERT_TRUE(again.has_value()) << again.error().text();
    EXPECT_EQ(*again, *expanded);
    EXPECT_EQ(write_expanded(*again), text);
  }
}

// With all keys and their comments such a text had 63 MB, and was refused when it was read again.
TEST(Expand, TheMostObstaclesOfAWorldAreWrittenInATextThatCanBeRead) {
  std::string text = "name: a\n" WALKER "obstacles:\n";
  constexpr int kSome = 1000;
  for (int i = 0; i < kSome; ++i) {
    text += fmt::format("  - {{name: b{}, box_m: [0.2, 0.3], x_m: {}, y_m: 1}}\n", i, i);
  }
  const auto expanded = expand_scenario_text(text, kData / "scenarios/s.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  const std::string written = write_expanded(*expanded);
  const auto again = expand_scenario_text(written, "/elsewhere/again.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_TRUE(*again == *expanded);
  // As large as the largest world file.
  constexpr std::size_t kMost = 100'000;
  EXPECT_LT(written.size() * (kMost / kSome), kMaxFileBytes / 4);
  const auto values = std::ranges::count(written, ',') + 2 * std::ranges::count(written, ':');
  EXPECT_LT(static_cast<std::size_t>(values) * (kMost / kSome), kMaxNodes);
}

TEST(Expand, ObstaclesAndChangesKeepAllThatIsSet) {
  const auto expanded = expand_scenario_text("name: a\n" WALKER R"(obstacles:
  - {name: tube, disc_radius_m: 0.1, x_m: 1, y_m: 2, yaw_deg: 3, z_m: [0.1, 2], layer: mapped_real,
     barcode: 72, barcode_z_m: [0.2, 0.9], colour: "#aabbcc"}
  - {name: wedge, polygon_m: [[0, 0], [1, 0], [0.5, 1]]}
  - {name: last, box_m: [1, 2]}
changes:
  - {at_s: 1, add_obstacle: {name: more, box_m: [1, 1], colour: "#000000"}}
  - {at_s: 2, move_obstacle: {name: more, x_m: 3}}
  - {at_s: 3, remove_obstacle: more}
  - {at_s: 4, robot: w, set: {program.goal: null, program.speed_mps: 0.25}}
)",
                                             kData / "scenarios/s.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  const auto again = expand_scenario_text(write_expanded(*expanded), "/elsewhere/again.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(*again, *expanded);
}

TEST(Expand, AnInlineRobotTakesTheVariablesOfItsEntry) {
  const auto expanded = expand_scenario(kData / "scenarios/small.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_EQ(expanded->groups.at(0).robot.body->shapes.at(0).outline.disc_radius_m, 0.2);
  EXPECT_EQ(expanded->groups.at(0).file, "");
}

TEST(Expand, AFileOfTheGuiHasRightsAndComponentsOfItsFolder) {
  const auto expanded = expand_scenario_text("name: a\ngui: {file: ../gui/lab.yaml}\n" WALKER,
                                             kData / "scenarios/s.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  const GuiFile& gui = expanded->scenario.gui;
  EXPECT_FALSE(gui.file.has_value());
  EXPECT_TRUE(gui.relay);
  ASSERT_EQ(gui.rights.size(), 1U);
  EXPECT_EQ(gui.rights[0].classes, std::vector{GuiClass::kReadings});
  ASSERT_EQ(gui.components.size(), 1U);
  EXPECT_EQ(*gui.components[0].module, (kData / "gui/panel.mjs").string());
  const auto again = expand_scenario_text(write_expanded(*expanded), "/elsewhere/again.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(*again, *expanded);
}

TEST(ExpandBadInput, AFileOfTheGui) {
  EXPECT_EQ(error_of("name: a\ngui: {file: no.yaml}\n" WALKER),
            "scenarios/s.yaml:2:13: cannot open `scenarios/no.yaml`: No such file or directory");
  EXPECT_EQ(error_of("name: a\ngui: {file: ../gui/wrong.yaml}\n" WALKER),
            "gui/wrong.yaml:3:14: `module`: found `panel.ts`, expected a file that ends in .js or "
            ".mjs");
  EXPECT_EQ(error_of("name: a\ngui: {file: ../gui/nested.yaml}\n" WALKER),
            "gui/nested.yaml:2:7: `file`: expected `rights`, `relay` and `components` in this "
            "file, not another file");
}

TEST(ExpandBadInput, FilesThatDoNotExistAreReportedAtTheLineThatNamesThem) {
  EXPECT_EQ(error_of("name: a\nrobots:\n  - {name: r, file: no.yaml}\n"),
            "scenarios/s.yaml:3:21: cannot open `scenarios/no.yaml`: No such file or directory");
  EXPECT_EQ(error_of("name: a\nworld: no.yaml\n" WALKER),
            "scenarios/s.yaml:2:8: cannot open `scenarios/no.yaml`: No such file or directory");
  EXPECT_EQ(error_of("name: a\nmaps:\n  - {file: no.yaml}\n" WALKER),
            "scenarios/s.yaml:3:12: cannot open `scenarios/no.yaml`: No such file or directory");
}

TEST(ExpandBadInput, AllMissingFilesAtOnce) {
  EXPECT_EQ(error_of("name: a\nworld: w.yaml\nrobots: [{name: r, file: r.yaml}]\n"),
            "scenarios/s.yaml:2:8: cannot open `scenarios/w.yaml`: No such file or directory\n"
            "scenarios/s.yaml:3:26: cannot open `scenarios/r.yaml`: No such file or directory");
}

TEST(ExpandBadInput, Names) {
  EXPECT_EQ(error_of("name: a\nrobots:\n  - {name: w-1, file: ../robots/walker.yaml}\n"
                     "  - {name: w, file: ../robots/walker.yaml, poses: [[0, 0, 0], [1, 1, 1]]}\n"),
            "scenarios/s.yaml:4:12: two robots are named `w-1`; the first is at "
            "scenarios/s.yaml:3:12");
  EXPECT_EQ(error_of("name: a\nworld: ../worlds/hall.yaml\nobstacles:\n"
                     "  - {name: tube-6, disc_radius_m: 1}\n" WALKER),
            "scenarios/s.yaml:4:12: two obstacles are named `tube-6`; the first is at "
            "worlds/hall.yaml:3:12");
}

TEST(ExpandBadInput, Variables) {
  EXPECT_EQ(error_of("name: a\nrobots:\n  - name: w\n    file: ../robots/walker.yaml\n"
                     "    variables: {rang: 3}\n"),
            "scenarios/s.yaml:5:23: unknown variable `rang`; the robot file declares range and "
            "colour");
  EXPECT_EQ(error_of("name: a\nrobots:\n  - name: w\n    file: ../robots/walker.yaml\n"
                     "    variables: {colour: blue}\n"),
            "robots/walker.yaml:7:11: `colour`: found the text \"blue\", expected `#rrggbb` with "
            "hexadecimal digits");
}

TEST(ExpandBadInput, PeriodsThatAreNoMultiplesOfTheStep) {
  EXPECT_EQ(error_of("name: a\nstep_s: 0.03\n" WALKER),
            "robots/walker.yaml:12:15: `period_s`: found 0.1, expected a multiple of the "
            "scenario's step (0.03 s)\n"
            "robots/walker.yaml:22:37: `period_s`: found 0.1, expected a multiple of the "
            "scenario's step (0.03 s)");
  const auto with_phase = [](std::string_view keys) {
    return fmt::format(
        "name: a\nrobots:\n  - name: r\n    robot:\n"
        "      body: {{shapes: [{{disc_radius_m: 0.1, z_m: [0, 0.1]}}]}}\n"
        "      sensors:\n        - {{name: s, driver: d, {}}}\n",
        keys);
  };
  EXPECT_EQ(error_of(with_phase("phase_s: 0.01")),
            "scenarios/s.yaml:7:41: `phase_s`: found 0.01, expected less than the period, which is "
            "the step (0.01 s)");
  EXPECT_EQ(error_of(with_phase("period_s: 0.1, phase_s: 0.005")),
            "scenarios/s.yaml:7:56: `phase_s`: found 0.005, expected a multiple of the scenario's "
            "step (0.01 s)");
  EXPECT_EQ(error_of(with_phase("period_s: 0.0000000001")),
            "scenarios/s.yaml:7:42: `period_s`: found 1e-10, expected a multiple of the scenario's "
            "step (0.01 s)");
  EXPECT_EQ(error_of(with_phase("period_s: 0.1, phase_s: 0.05")), "none");
}

/// Of a robot with these keys in a scenario with that step.
std::string report_steps(std::string_view keys, double step_s) {
  const auto expanded = expand_scenario_text(
      fmt::format("name: a\nstep_s: {}\nrobots:\n  - name: r\n    robot:\n"
                  "      body: {{shapes: [{{disc_radius_m: 0.1, z_m: [0, 0.1]}}]}}\n"
                  "      {}\n",
                  step_s, keys),
      "s.yaml");
  if (!expanded) return expanded.error().text();
  return fmt::format("{}", report_period_steps(*expanded, expanded->robots[0]));
}

TEST(Expand, ReportsComeEachTenthOfASecondOrAsTold) {
  EXPECT_EQ(report_steps("", 0.01), "10");
  EXPECT_EQ(report_steps("", 0.03), "4") << "the next multiple";
  EXPECT_EQ(report_steps("", 0.25), "1");
  EXPECT_EQ(report_steps("report_period_s: 0.5", 0.01), "50");
  EXPECT_EQ(report_steps("report_period_s: 0.05", 0.02),
            "s.yaml:7:24: `report_period_s`: found 0.05, expected a multiple of the scenario's "
            "step (0.02 s)");
}

TEST(ExpandBadInput, SensorsOfChecksAndPicture) {
  EXPECT_EQ(error_of("name: a\n" WALKER "checks: {sightings: {real: lasre, twin: laser}}\n"),
            "scenarios/s.yaml:3:28: `real`: no robot has a sensor `lasre`; did you mean `laser`?");
  EXPECT_EQ(error_of("name: a\nrobots:\n  - {name: w, file: ../robots/walker.yaml}\n"
                     "  - {name: r, file: ../robots/recorded.yaml}\n"
                     "checks: {sightings: {real: camera, twin: laser}}\n"),
            "scenarios/s.yaml:5:42: no robot has both the sensors `camera` and `laser`");
  EXPECT_EQ(error_of("name: a\n" WALKER "picture: {odometry_sensor: odometry}\n"),
            "scenarios/s.yaml:3:28: `odometry_sensor`: no robot has a sensor `odometry`; there are "
            "laser");
}

/// Who reads the code could not tell them apart.
TEST(ExpandBadInput, TwoBodiesWithOneBarcode) {
  const std::string post = ", disc_radius_m: 0.1, x_m: 0, y_m: 0, z_m: [0, 1], barcode: 7}";
  EXPECT_EQ(error_of("name: a\n" WALKER "obstacles:\n  - {name: p" + post + "\n  - {name: q" +
                     post + "\n  - {name: r" + post + "\n"),
            "scenarios/s.yaml:5:12: obstacle `q` carries the barcode 7, and so does obstacle `p` "
            "(scenarios/s.yaml:4:12); expected a code of its own");
  const std::string robot = "{body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 1]}], barcode: 7}}";
  EXPECT_EQ(error_of("name: a\nobstacles: [{name: p" + post +
                     "]\nrobots:\n  - {name: r, robot: " + robot + "}\n"),
            "scenarios/s.yaml:4:12: robot `r` carries the barcode 7, and so does obstacle `p` "
            "(scenarios/s.yaml:2:20); expected a code of its own");
  EXPECT_EQ(error_of("name: a\nrobots:\n  - {name: r, poses: [[0, 0, 0], [1, 0, 0]], robot: " +
                     robot + "}\n"),
            "scenarios/s.yaml:3:12: robot `r-2` carries the barcode 7, and so does robot `r-1` "
            "(scenarios/s.yaml:3:12); expected a code of its own");
}

TEST(ExpandBadInput, TooManyRobots) {
  std::string text = "name: a\nrobots:\n";
  for (const char* name : {"a", "b"}) {
    text += fmt::format(
        "  - {{name: {}, file: ../robots/walker.yaml, "
        "scatter: {{count: 60000, x_m: [0, 1], y_m: [0, 1]}}}}\n",
        name);
  }
  EXPECT_EQ(error_of(text), "scenarios/s.yaml:4:12: more than 100000 robots");
}

}  // namespace
}  // namespace rave::config
