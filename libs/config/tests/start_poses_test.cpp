// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

const std::filesystem::path kStartFile = RAVE_SOURCE_DIR "/libs/config/tests/data/scenarios/s.yaml";

Result<ExpandedScenario> started(const std::string& start) {
  return expand_scenario_text(
      "name: s\nrobots:\n  - {name: w, file: ../robots/walker.yaml, " + start + "}\n", kStartFile);
}

std::string start_error(const std::string& start) {
  const auto expanded = started(start);
  return expanded ? "none" : expanded.error().message;
}

std::vector<PoseFile> poses_with(const std::string& start) {
  const auto expanded = started(start);
  EXPECT_TRUE(expanded.has_value()) << expanded.error().text();
  std::vector<PoseFile> poses;
  for (const ExpandedRobot& robot : expanded->robots) poses.push_back(robot.pose.value());
  return poses;
}

TEST(StartPoses, OfAGridAreRows) {
  EXPECT_EQ(poses_with("grid: {count: 5, columns: 2, x_m: 1, y_m: -1, step_m: 0.5, yaw_deg: 90}"),
            (std::vector<PoseFile>{
                {1, -1, 90}, {1.5, -1, 90}, {1, -0.5, 90}, {1.5, -0.5, 90}, {1, 0, 90}}));
  // Without `columns` about as many as rows.
  const auto square = poses_with("grid: {count: 10, step_m: 1}");
  EXPECT_EQ(square[3], (PoseFile{3, 0, 0}));
  EXPECT_EQ(square[4], (PoseFile{0, 1, 0}));
  EXPECT_EQ(square[9], (PoseFile{1, 2, 0}));
}

TEST(StartPoses, OfARingLookOutInOrAlong) {
  const auto yaws = [](const char* facing) {
    std::vector<double> yaws_deg;
    for (const PoseFile& pose : poses_with(
             std::string("ring: {count: 4, x_m: 1, y_m: 2, radius_m: 3, facing: ") + facing + "}"))
      yaws_deg.push_back(pose.yaw_deg);
    return yaws_deg;
  };
  EXPECT_EQ(yaws("out"), (std::vector<double>{0, 90, -180, -90}));
  EXPECT_EQ(yaws("in"), (std::vector<double>{180, 270, 0, 90}));
  EXPECT_EQ(yaws("along"), (std::vector<double>{90, 180, -90, 0}));
  const auto ring = poses_with("ring: {count: 4, x_m: 1, y_m: 2, radius_m: 3}");
  const PoseFile expected[] = {{4, 2, 0}, {1, 5, 90}, {-2, 2, -180}, {1, -1, -90}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(ring[i].x_m, expected[i].x_m, 1e-12);
    EXPECT_NEAR(ring[i].y_m, expected[i].y_m, 1e-12);
  }
}

TEST(StartPoses, HaveNumberedNamesAndAreTheSameWhenWrittenAndReadAgain) {
  const auto expanded = started("ring: {count: 7, radius_m: 1.3, facing: in}");
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  EXPECT_EQ(expanded->robots[0].name, "w-1");
  EXPECT_EQ(expanded->robots[6].name, "w-7");
  const auto again = expand_scenario_text(write_expanded(*expanded), kStartFile);
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(again->robots, expanded->robots);
}

TEST(StartPoses, ThatAreNoneAreRefused) {
  EXPECT_EQ(start_error("grid: {count: 4, step_m: 1}, ring: {count: 4, radius_m: 1}"),
            "the robot `w` has more than one of `pose`, `poses`, `grid`, `ring` and `scatter`");
  EXPECT_EQ(start_error("grid: {count: 4, step_m: 1}, twin: ../robots/walker.yaml"),
            "`twin` needs a single robot, but `w` stands for several");
  EXPECT_EQ(start_error("grid: {count: 4, columns: 1, step_m: 900000}"),
            "robot `w-3` is farther than 1000000 m from the origin");
  EXPECT_EQ(start_error("ring: {count: 2, radius_m: 1, facing: north}"),
            "`facing`: found the text \"north\", expected one of out, in and along");
  EXPECT_EQ(start_error("grid: {count: 4}"),
            "missing key `step_m`: expected a number (from 0 to 1000000, in metres)");
}

}  // namespace
}  // namespace rave::config
