// SPDX-License-Identifier: Apache-2.0
// A program that takes the whole run with it is named with its robot.
#include <gtest/gtest.h>

#include <fstream>

#include "process.hpp"

namespace rave::cli_test {
namespace {

/// Runs robots with the crashing program among others that wander.
Ended run_with(const std::string& robots) {
  const TemporaryFolder folder;
  const std::string scenario = folder.path() / "crash.yaml";
  std::ofstream(scenario) << "name: crash\nduration_s: 5\nrobots:\n" << robots;
  return run_rave({"run", scenario, "--output", folder.path() / "out", "--no-picture", "--quiet",
                   "--plugins", std::string(RAVE_BINARY_DIR) + "/tests/plugins/crash"});
}

std::string robot(const std::string& name, const std::string& program, const std::string& where) {
  return "  - {name: " + name + ", " + where +
         ", robot: {body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 1]}]}, actuators: [{name: "
         "wheels, "
         "driver: differential_drive}], controllers: [{name: drive, driver: velocity, actuator: "
         "wheels}], program: {" +
         program + ", period_s: 0.1}}}\n";
}

// With a sanitizer its own report comes instead.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(Crash, NamesRobotAndProgram) {
  const Ended ended =
      run_with(robot("anna", "driver: crash", "pose: {x_m: 0, y_m: 0}") +
               robot("bert", "driver: crash, isolate: true", "pose: {x_m: 3, y_m: 0}"));
  EXPECT_EQ(ended.exit_code, -1) << "ended by the signal, as without the note";
  EXPECT_NE(
      ended.err.find("rave: crashed (segmentation fault) in program `crash` of robot `anna`; "
                     "with `isolate: true` in its robot file a crash costs that robot alone\n"),
      std::string::npos)
      << ended.err;
}

TEST(Crash, OfRobotsThatDecideTogetherNamesTheFirstAndTheLast) {
  const Ended ended = run_with(robot("many", "driver: crash", "poses: [[0, 0, 0], [1, 0, 0]]"));
  EXPECT_EQ(ended.exit_code, -1);
  EXPECT_NE(ended.err.find("in program `crash` of one of the robots `many-1` to `many-2`"),
            std::string::npos)
      << ended.err;
}

#endif

TEST(Crash, OfAnIsolatedProgramEndsThatProgramAlone) {
  const Ended ended =
      run_with(robot("bert", "driver: crash, isolate: true", "pose: {x_m: 3, y_m: 0}"));
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_EQ(ended.err.find("rave: crashed"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
