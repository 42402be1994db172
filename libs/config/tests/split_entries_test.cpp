// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

const std::filesystem::path kSplitFile = RAVE_SOURCE_DIR "/libs/config/tests/data/scenarios/s.yaml";

Result<ExpandedScenario> split(const std::string& robots, const std::string& rest = {}) {
  return expand_scenario_text("name: s\n" + rest + "robots:\n" + robots, kSplitFile);
}

std::string split_error(const std::string& robots, const std::string& rest = {}) {
  const auto expanded = split(robots, rest);
  return expanded ? "none"
                  : expanded.error().text().substr(kSplitFile.parent_path().string().size() + 1);
}

std::vector<double> ranges_of(const ExpandedScenario& scenario) {
  std::vector<double> ranges_m;
  for (const ExpandedRobot& robot : scenario.robots) {
    const RawNode& params = scenario.group_of(robot).robot.sensors.at(0).params;
    ranges_m.push_back(params.find("range_m")->as_double().value());
  }
  return ranges_m;
}

TEST(VariablesAsLists, GiveEachRobotItsOwnValue) {
  const auto expanded = split(
      "  - {name: w, file: ../robots/walker.yaml, ring: {count: 3, radius_m: 2}, team: green,\n"
      "     variables: {range: [1, 2.5, 3], colour: \"#112233\"}}\n"
      "  - {name: v, file: ../robots/walker.yaml, pose: {x_m: 9}}\n");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_EQ(ranges_of(*expanded), (std::vector<double>{1, 2.5, 3, 4}));
  EXPECT_EQ(expanded->robots[1].name, "w-2");
  EXPECT_EQ(expanded->group_of(expanded->robots[2]).team, "green");
  EXPECT_EQ(expanded->group_of(expanded->robots[2]).robot.body->colour, "#112233");
  const auto plain = split(
      "  - {name: w, file: ../robots/walker.yaml, ring: {count: 3, radius_m: 2}}\n"
      "  - {name: v, file: ../robots/walker.yaml, pose: {x_m: 9}}\n");
  ASSERT_TRUE(plain.has_value());
  for (std::size_t r = 0; r < 4; ++r) EXPECT_EQ(expanded->robots[r].pose, plain->robots[r].pose);
}

TEST(VariablesAsLists, KeepTheNameOfTheEntryForChecksChangesAndHosts) {
  const auto expanded = split(
      "  - {name: w, file: ../robots/walker.yaml, poses: [[0, 0, 0], [3, 0, 0]],\n"
      "     variables: {range: [1, 2]}}\n"
      "  - {name: v, file: ../robots/walker.yaml, pose: {x_m: 9}}\n",
      "hosts: [{name: left, robots: [w]}, {name: right}]\n"
      "changes: [{at_s: 1, robot: w, set: {program.speed_mps: 0.1}}]\n"
      "checks: {arrivals: [{robot: w, x_m: 1, y_m: 1}]}\n");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_EQ(robots_named(*expanded, "w"), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(robots_named(*expanded, "w-2"), (std::vector<std::size_t>{1}));
  const auto hosts = plan_hosts(*expanded);
  ASSERT_TRUE(hosts.has_value());
  EXPECT_EQ(hosts->at(0).robots, (std::vector<std::size_t>{0, 1}));
  const auto again = expand_scenario_text(write_expanded(*expanded), kSplitFile);
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(robots_named(*again, "w"), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(again->robots, expanded->robots);
  EXPECT_EQ(ranges_of(*again), ranges_of(*expanded));
}

TEST(VariablesAsLists, WorkForScatteredAndInlineRobots) {
  const auto expanded = split(
      "  - name: w\n"
      "    scatter: {count: 2, x_m: [0, 5], y_m: [0, 5]}\n"
      "    variables: {size: [0.1, 0.2]}\n"
      "    robot: {variables: {size: 1}, body: {shapes: [{disc_radius_m: $(size), z_m: [0, "
      "1]}]}}\n");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  ASSERT_EQ(expanded->groups.size(), 2U);
  EXPECT_EQ(expanded->groups[1].robot.body->shapes.at(0).outline.disc_radius_m, 0.2);
  EXPECT_EQ(expanded->groups[1].scatter->count, 1);
}

TEST(VariablesAsLists, NeedAValueForEachRobot) {
  EXPECT_EQ(
      split_error("  - {name: w, file: ../robots/walker.yaml, poses: [[0, 0, 0], [3, 0, 0]],\n"
                  "     variables: {range: [1, [2]]}}\n"),
      "s.yaml:4:29: the variable `range`: found a list, expected a number, true, false or "
      "text");
}

TEST(RealRobots, AreTheFirstOnesAndTheOthersHaveNoTwin) {
  const std::string plain =
      "  - {name: w, file: ../robots/walker.yaml, twin: ../robots/walker.yaml, shadow: true,\n"
      "     grid: {count: 3, step_m: 1}, real: ";
  const auto expanded = split(
      "  - {name: w, file: ../robots/walker.yaml, twin: ../robots/recorded.yaml, shadow: true,\n"
      "     grid: {count: 3, step_m: 1}, real: 1}\n");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  ASSERT_EQ(expanded->groups.size(), 3U);
  EXPECT_TRUE(expanded->groups[0].file.ends_with("robots/recorded.yaml"));
  EXPECT_TRUE(expanded->groups[0].twin->file.ends_with("robots/walker.yaml"));
  EXPECT_TRUE(expanded->groups[0].shadow);
  EXPECT_TRUE(expanded->groups[2].file.ends_with("robots/walker.yaml"));
  EXPECT_FALSE(expanded->groups[2].twin || expanded->groups[2].shadow);
  EXPECT_EQ(robots_named(*expanded, "w").size(), 3U);
  EXPECT_EQ(split(plain + "0}\n").value().groups[0].twin, std::nullopt);
  EXPECT_EQ(split_error(plain + "4}\n"),
            "s.yaml:4:41: `real`: found 4, expected at most 3, the robots of `w`");
  EXPECT_EQ(split_error("  - {name: w, file: ../robots/walker.yaml, real: 1}\n"),
            "s.yaml:3:50: `real` needs `twin`, the file of the real robot");
  EXPECT_EQ(split_error("  - {name: w, file: ../robots/walker.yaml, twin: ../robots/walker.yaml,\n"
                        "     real: 1, scatter: {count: 2, x_m: [0, 1], y_m: [0, 1]}}\n")
                .substr(0, 62),
            "s.yaml:4:12: `real`: a real robot stands where it stands; expe");
}

}  // namespace
}  // namespace rave::config
