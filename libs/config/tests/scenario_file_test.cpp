// SPDX-License-Identifier: Apache-2.0
#include "rave/config/scenario_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

const std::filesystem::path kFiles = RAVE_SOURCE_DIR "/libs/config/tests/data";

TEST(RobotFileText, VariablesTakeTheTypeOfTheirValueOrBecomeText) {
  const auto robot =
      read_robot_file(kFiles / "robots/recorded.yaml", {{"robot", RawNode::integer(3)}});
  ASSERT_TRUE(robot.has_value()) << robot.error().text();
  EXPECT_EQ(robot->description,
            "Robot 3 of the recording; its barcode is 5, written as $(barcode)");
  EXPECT_EQ(robot->body->barcode, 5);
  EXPECT_EQ(robot->variables.at("robot").as_int(), 3);
  const RawNode& params = robot->sensors[0].params;
  EXPECT_EQ(params.find("robot")->as_int(), 3);
  EXPECT_EQ(params.find("file")->as_text(), "data/Robot3.dat");
  EXPECT_EQ(params.find("robot")->where().line, 14);
  EXPECT_EQ(robot->pose_from->value, "mocap");
  EXPECT_EQ(robot->source_frame, (PoseFile{1, 0, 90}));
  EXPECT_EQ(robot->body->shapes[1].outline.box_m, (std::array{0.1, 0.1}));
  EXPECT_EQ(robot->sensors[2].senses->value,
            (std::vector{SensedLayer::kMappedReal, SensedLayer::kRealRobots}));
  EXPECT_FALSE(robot->sensors[0].senses.has_value());
}

TEST(RobotFileText, ValuesKeepTheirPlaces) {
  const auto robot = read_robot_file(kFiles / "robots/walker.yaml");
  ASSERT_TRUE(robot.has_value()) << robot.error().text();
  const SensorFile& laser = robot->sensors.at(0);
  EXPECT_EQ(laser.driver.where.text(), (kFiles / "robots/walker.yaml").string() + ":10:13");
  EXPECT_EQ(**laser.period_s, 0.1);
  EXPECT_EQ(laser.filters.at(0).median->window, 5);
  EXPECT_EQ(laser.filters.at(1).exponential->time_constant_s, 0.2);
  EXPECT_EQ(laser.noise.length_sigma_m, 0.01);
  EXPECT_EQ(*robot->controllers.at(0).actuator, "wheels");
  EXPECT_EQ(robot->body->colour, "#56b4e9");
}

TEST(RobotFileText, ReadsBackWhatItWrites) {
  for (const char* name : {"robots/walker.yaml", "robots/recorded.yaml"}) {
    const auto robot = read_robot_file(kFiles / name);
    ASSERT_TRUE(robot.has_value()) << robot.error().text();
    const auto again = read_robot_text(write_robot(*robot), "again.yaml");
    ASSERT_TRUE(again.has_value()) << again.error().text();
    EXPECT_EQ(*again, *robot);
  }
}

TEST(WorldFileText, HasRoomForAsManyObstaclesAsItsReferenceSays) {
  std::string text = "obstacles:\n";
  for (int i = 0; i < 100'000; ++i) {
    text += fmt::format("  - {{name: b{}, box_m: [0.2, 0.3], x_m: {}, y_m: {}}}\n", i, i % 300,
                        i / 300);
  }
  const auto world = read_world_text(text, "w.yaml");
  ASSERT_TRUE(world.has_value()) << world.error().text();
  EXPECT_EQ(world->obstacles.size(), 100'000U);
}

TEST(WorldFileText, DefaultsAndRoundTrip) {
  const auto world = read_world_file(kFiles / "worlds/hall.yaml");
  ASSERT_TRUE(world.has_value()) << world.error().text();
  ASSERT_EQ(world->obstacles.size(), 2U);
  EXPECT_EQ(world->obstacles[0].barcode, 72);
  EXPECT_EQ(world->obstacles[0].layer, ObstacleLayer::kMappedReal);
  EXPECT_EQ(world->obstacles[0].z_m, (HeightRange{0, 0.5}));
  EXPECT_EQ(*world->maps.at(0).file, "../maps/lab.yaml");
  const auto again = read_world_text(write_world(*world), "again.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(*again, *world);
}

TEST(PaceText, ReadsAndWrites) {
  EXPECT_TRUE(parse_pace("max")->is_max());
  EXPECT_EQ(parse_pace("realtime")->factor, 1);
  EXPECT_EQ(parse_pace("0.5x")->factor, 0.5);
  for (const char* text : {"max", "realtime", "10x", "0.25x"}) {
    EXPECT_EQ(*parse_pace(to_string(*parse_pace(text))), *parse_pace(text)) << text;
  }
  for (const char* text : {"", "x", "0x", "-1x", "10", ".infx", ".nanx", "10 x", "Max"}) {
    EXPECT_FALSE(parse_pace(text).has_value()) << text;
  }
}

TEST(Variables, EscapingIsUndoneBySubstitution) {
  for (const char* text : {"$(a)", "$$(a)", "x$(", "$$$(b)c$(d", "$", "$$"}) {
    RawNode tree = RawNode::mapping();
    tree.append("t", RawNode::text(text));
    const RawNode before = tree;
    escape_variables(tree);
    Diagnostics diagnostics;
    substitute_variables(tree, {}, diagnostics);
    EXPECT_TRUE(diagnostics.ok()) << text;
    EXPECT_EQ(tree, before) << text;
  }
}

TEST(ScenarioFile, AnOpenEndIsTheWordNone) {
  const auto read = [](const std::string& duration) {
    return read_scenario_text(
        "name: a\nduration_s: " + duration + "\nrobots: [{name: r, file: r}]\n", "s.yaml");
  };
  EXPECT_TRUE(read("none").value().duration_s.is_open());
  EXPECT_FALSE(read("3e8").value().duration_s.is_open());
  const auto expanded = expand_scenario_text(
      "name: a\nduration_s: none\nrobots: [{name: r, file: robots/walker.yaml}]\n",
      kFiles / "s.yaml");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_NE(write_expanded(*expanded).find("\nduration_s: none"), std::string::npos);
  EXPECT_EQ(
      read("never").error().text(),
      "s.yaml:2:13: `duration_s`: found the text \"never\", expected a number (greater than 0 "
      "and at most 1000000000, in seconds), or `none`");
  EXPECT_EQ(
      read("0").error().text(),
      "s.yaml:2:13: `duration_s`: found the number 0, expected a number (greater than 0 and at "
      "most 1000000000, in seconds)");
}

}  // namespace
}  // namespace rave::config
