// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "process.hpp"

namespace rave::cli_test {
namespace {

/// What `rave check` says against a file, before its verdict.
std::string complaint(const std::string& file, const std::string& taken_for) {
  Ended ended = run_rave({"check", file});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.out, "");
  const std::string verdict = file + ": not usable" + taken_for + "\n";
  EXPECT_TRUE(ended.err.ends_with(verdict)) << ended.err;
  if (ended.err.size() >= verdict.size()) ended.err.resize(ended.err.size() - verdict.size());
  return ended.err;
}

constexpr const char* kRobot = " (read as a robot file)";
constexpr const char* kWorld = " (read as a world file)";
constexpr const char* kScenario = " (read as a scenario file)";

/// Nobody writes to it, so whoever reads it waits for ever.
TEST(Check, ANamedPipeInThePlaceOfAFileIsRefused) {
  const TemporaryFolder folder;
  const std::string pipe = folder.path() / "robot.yaml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string scenario = folder.path() / "scenario.yaml";
  std::ofstream(scenario) << "name: a\nrobots:\n  - {name: r, file: robot.yaml}\n";
  const Ended ended = run_rave({"check", scenario});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(
      ended.err.find("scenario.yaml:3:21: cannot read `" + pipe + "`: it is not a regular file"),
      std::string::npos)
      << ended.err;
  const Ended itself = run_rave({"check", pipe});
  EXPECT_EQ(itself.exit_code, 2);
  EXPECT_NE(itself.err.find("it is not a regular file"), std::string::npos) << itself.err;
  EXPECT_EQ(run_rave({"info", pipe}).exit_code, 2);
}

/// Not taken for a damaged recording.
TEST(Check, TheGuiServerTakesAScenarioByItsFile) {
  const TemporaryFolder folder;
  const std::string scenario = folder.path() / "scenario.yaml";
  std::ofstream(scenario) << "name: a\nrobots:\n  - {name: r, file: robot.yaml}\n";
  const Ended ended = run_rave({"gui", scenario, "--no-open"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("scenario.yaml:3:21: "), std::string::npos) << ended.err;
}

TEST(Check, GoodFilesOfEachKind) {
  const Ended ended =
      run_rave({"check", "good_robot.yaml", "good_world.yaml", "good_scenario.yaml"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(
      ended.out,
      "good_robot.yaml: ok: simulated robot with 4 sensors, 1 actuator, 1 controller, program "
      "`wander`\n"
      "good_world.yaml: ok: world with 3 obstacles\n"
      "good_scenario.yaml: ok: scenario with 3 robots (3 simulated, 0 real), 3 obstacles, 7 "
      "drivers, 2 s\n");
}

TEST(Check, WhatIsHardlyMeantIsAWarningAtItsPlace) {
  const TemporaryFolder folder;
  const std::string scenario = folder.path() / "scenario.yaml";
  std::ofstream(scenario) << "name: a\nduration_s: 5\n"
                             "obstacles: [{name: box, box_m: [1, 1], x_m: 3, z_m: [0, 1]}]\n"
                             "changes: [{at_s: 6, remove_obstacle: box}]\n"
                             "checks: {arrivals: [{robot: r, x_m: 3, y_m: 0}]}\n"
                             "robots: [{name: r, pose: {}, robot: {body: {shapes: "
                             "[{disc_radius_m: 0.2, z_m: [0, 0.3]}]}}}]\n";
  const Ended ended = run_rave({"check", scenario});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find(scenario + ":5:29: warning: the target (3, 0) of `r` is inside the "
                                      "obstacle `box`\n"),
            std::string::npos)
      << ended.out;
  EXPECT_NE(ended.out.find(scenario + ":4:18: warning: the change at 6 s never happens: the run "
                                      "ends at 5 s\n"),
            std::string::npos)
      << ended.out;
}

TEST(Check, ARobotThatSensesNothingAroundItIsNoted) {
  const TemporaryFolder folder;
  const std::string scenario = folder.path() / "scenario.yaml";
  std::ofstream(scenario)
      << "name: a\nrobots:\n  - name: r\n    pose: {}\n    robot:\n"
         "      body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
         "      sensors: [{name: odometry, driver: virtual_odometry}]\n"
         "      actuators: [{name: wheels, driver: differential_drive}]\n"
         "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
         "      program: {driver: wander, period_s: 0.1}\n";
  const Ended ended = run_rave({"check", scenario});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("note: robot `r` has no sensor of its surroundings"), std::string::npos)
      << ended.out;
}

/// Checks a file of this text.
Ended check_text(const char* name, std::string_view text) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / name;
  std::ofstream(file) << text;
  return run_rave({"check", file});
}

TEST(Check, AComponentOfThePageThatIsNoFileHasItsPlace) {
  const Ended ended = check_text("scenario.yaml",
                                 "name: a\nrobots:\n  - name: r\n    pose: {}\n    robot:\n"
                                 "      body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
                                 "gui:\n  components: [{module: gone.mjs, roles: [observer]}]\n");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("scenario.yaml:8:25: `module`: the component `"), std::string::npos)
      << ended.err;
  EXPECT_NE(ended.err.find("gone.mjs` of the page is not a file"), std::string::npos) << ended.err;
}

TEST(Check, ARobotAloneIsStartedAndWhatIsRefusedHasItsPlace) {
  const Ended ended =
      check_text("robot.yaml",
                 "body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
                 "sensors: [{name: odometry, driver: virtual_odometry}]\n"
                 "actuators: [{name: wheels, driver: differential_drive}]\n"
                 "controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
                 "program: {driver: flock, period_s: 0.1}\n");
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_NE(ended.err.find("robot.yaml:5:19: robot `"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("`, program `flock` (driver `flock`): robot `"), std::string::npos)
      << ended.err;
}

TEST(Check, WhatUsesABadDeviceIsNotComplainedOfAsWell) {
  const Ended ended =
      check_text("robot.yaml",
                 "body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
                 "devices: [{name: base, driver: ros2, params: {multicast: on}}]\n"
                 "sensors:\n  - {name: odometry, driver: ros2_odometry, device: base}\n"
                 "  - name: laser\n    driver: hybrid_ranges\n"
                 "    real: {driver: ros2_laser, device: base}\n"
                 "    virtual: {driver: virtual_laser}\n"
                 "pose_from: odometry\n");
  EXPECT_NE(ended.err.find("robot.yaml:2:"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("`multicast`: found"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("there is no device"), std::string::npos) << ended.err;
}

TEST(Check, NamesOfDriversWithTheWordAreNamed) {
  const Ended ended = check_text("robot.yaml",
                                 "body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
                                 "sensors: [{name: eyes, driver: laser, params: {}}]\n");
  EXPECT_NE(ended.err.find("names with it: "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("scip_laser"), std::string::npos) << ended.err;
  EXPECT_EQ(ended.err.find("virtual_sonar"), std::string::npos) << ended.err;
}

TEST(Check, AllUnknownDriversAndParametersAtOnce) {
  const std::string text = complaint("unknown_driver.yaml", kRobot);
  const std::string own =
      "; the folder of your own plug-ins is given with --plugins or RAVE_PLUGIN_PATH\n";
  EXPECT_EQ(text.substr(0, text.find(own)),
            "unknown_driver.yaml:4:26: there is no sensor driver `virtul_laser`; did you mean "
            "`virtual_laser`?");
  EXPECT_NE(
      text.find(own +
                "    4 |   - {name: eyes, driver: virtul_laser}\n"
                "      |                          ^\n"
                "unknown_driver.yaml:7:24: driver `virtual_sonar`: `cone_deg`: found the "
                "number 500, expected a number (from 0.1 to 180, in degrees)\n"
                "    7 |     params: {cone_deg: 500}\n"
                "      |                        ^\n"
                "unknown_driver.yaml:11:27: there is no controller `flying_carpet`; there are "
                "goal_point, pedals and velocity" +
                own +
                "   11 |   - {name: drive, driver: flying_carpet, actuator: wheels}\n"
                "      |                           ^\n"),
      std::string::npos)
      << text;
}

TEST(Check, SelfCrossingPolygon) {
  EXPECT_EQ(complaint("self_crossing.yaml", kRobot),
            "self_crossing.yaml:4:18: `polygon_m`: the polygon crosses or touches itself: edge 0 "
            "(vertex 0 to 1) and edge 2 (vertex 2 to 3)\n"
            "    4 |     - polygon_m: [[0, 0], [1, 1], [1, 0], [0, 1]]\n"
            "      |                  ^\n");
}

TEST(Check, TwoRobotsOfOneName) {
  EXPECT_EQ(complaint("two_of_one_name.yaml", kScenario),
            "two_of_one_name.yaml:5:12: two robots are named `anna`; the first is at "
            "two_of_one_name.yaml:4:12\n"
            "    5 |   - {name: anna, file: good_robot.yaml, pose: {x_m: 2}}\n"
            "      |            ^\n");
}

TEST(Check, MapFileMissing) {
  EXPECT_EQ(complaint("no_map.yaml", kWorld),
            "no_map.yaml:3:12: cannot open `nowhere.yaml`: No such file or directory\n"
            "    3 |   - {file: nowhere.yaml, z_m: [0, 2]}\n"
            "      |            ^\n");
}

TEST(Check, NegativeRange) {
  EXPECT_EQ(complaint("negative_range.yaml", kRobot),
            "negative_range.yaml:7:20: driver `virtual_laser`: `range_max_m`: found the number -3, "
            "expected a number (from 0 to 1000, in metres)\n"
            "    7 |       range_max_m: -3\n"
            "      |                    ^\n");
}

TEST(Check, EmptyScenario) {
  EXPECT_EQ(complaint("empty_scenario.yaml", kScenario),
            "empty_scenario.yaml:3:9: `robots`: found a list of 0 items, expected a list of 1 to "
            "100000 items, each a mapping\n"
            "    3 | robots: []\n"
            "      |         ^\n");
}

TEST(Check, RealRobotWithoutPoseSource) {
  EXPECT_EQ(complaint("real_without_pose.yaml", kRobot),
            "real_without_pose.yaml:2:7: robot `robot` is real, so others can sense it only if its "
            "pose is known: expected `pose_from:` with the name of a sensor that gives "
            "a pose or odometry\n"
            "    2 | body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\n"
            "      |       ^\n");
}

TEST(Check, FileOfNoKind) {
  EXPECT_EQ(
      complaint("no_kind.yaml", ""),
      "no_kind.yaml:2:1: found the key colour; expected a robot file (with `body`), a world file "
      "(`obstacles` or `maps`), a scenario file (`robots`) or an experiment file (`factors`)\n"
      "    2 | colour: blue\n"
      "      | ^\n");
}

TEST(Check, OneBadFileAmongGoodOnes) {
  const Ended ended = run_rave({"check", "good_robot.yaml", "no_kind.yaml", "nowhere.yaml"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.out.substr(0, 19), "good_robot.yaml: ok");
  EXPECT_NE(ended.err.find("cannot open `nowhere.yaml`: No such file"), std::string::npos);
}

TEST(Check, ExpandedFileIsGoodAndTheSame) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "complete.yaml";
  const Ended first = run_rave({"check", "good_robot.yaml", "--expand"});
  ASSERT_EQ(first.exit_code, 0);
  std::filesystem::create_directories(folder.path());
  {
    std::FILE* const stream = std::fopen(file.c_str(), "w");
    ASSERT_NE(stream, nullptr);
    std::fwrite(first.out.data(), 1, first.out.size(), stream);
    std::fclose(stream);
  }
  EXPECT_EQ(run_rave({"check", file, "--expand"}).out, first.out);
}

TEST(Check, DrawsEachKindBothWays) {
  const TemporaryFolder folder;
  for (const std::string kind : {"robot", "world", "scenario"}) {
    for (const std::string ending : {".svg", ".png"}) {
      const std::string picture = folder.path() / (kind + ending);
      const Ended ended = run_rave({"check", "good_" + kind + ".yaml", "--draw", picture});
      EXPECT_EQ(ended.exit_code, 0) << ended.err;
      EXPECT_GT(content_of(picture).size(), 1000U) << picture;
    }
  }
  EXPECT_NE(content_of(folder.path() / "robot.svg").find("rear_sonar"), std::string::npos);
  EXPECT_EQ(run_rave({"check", "good_robot.yaml", "--draw", "x.gif"}).err,
            "rave: `x.gif`: expected a file name that ends in `.svg` or `.png`\n");
}

}  // namespace
}  // namespace rave::cli_test
