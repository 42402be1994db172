// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::tests {
namespace {

config::RobotFile robot(const std::string& name) {
  const auto scenario = config::expand_scenario_text(
      "name: one\nduration_s: 1\nrobots:\n  - {name: a, file: ../robots/" + name +
          ".yaml, pose: {x_m: 0, y_m: 0}}\n",
      std::filesystem::path(RAVE_SOURCE_DIR) / "scenarios/one.yaml");
  EXPECT_TRUE(scenario.has_value()) << (scenario ? "" : scenario.error().text());
  return scenario ? scenario->groups.at(0).robot : config::RobotFile{};
}

/// What a program can see of a robot, and what it is told to do.
TEST(CreateTwin, TheFilesDifferInDriversOnly) {
  const config::RobotFile real = robot("create");
  const config::RobotFile simulated = robot("create-simulated");
  ASSERT_EQ(real.sensors.size(), simulated.sensors.size());
  for (std::size_t i = 0; i < real.sensors.size(); ++i) {
    EXPECT_EQ(real.sensors[i].name.value, simulated.sensors[i].name.value);
    EXPECT_EQ(real.sensors[i].mount.value, simulated.sensors[i].mount.value);
    EXPECT_NE(real.sensors[i].driver.value, simulated.sensors[i].driver.value);
  }
  ASSERT_EQ(real.actuators.size(), 1U);
  ASSERT_EQ(simulated.actuators.size(), 1U);
  EXPECT_EQ(real.actuators[0].name.value, simulated.actuators[0].name.value);
  EXPECT_NE(real.actuators[0].driver.value, simulated.actuators[0].driver.value);
  EXPECT_EQ(real.controllers, simulated.controllers);
  EXPECT_EQ(real.program, simulated.program);
  EXPECT_EQ(real.pose_from, simulated.pose_from);
  EXPECT_EQ(real.body, simulated.body);
  EXPECT_EQ(real.staleness_s, simulated.staleness_s);
}

}  // namespace
}  // namespace rave::tests
