// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <nlohmann/json.hpp>

#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class RearSonar : public ScenarioTest {
 protected:
  nlohmann::json result() const {
    std::ifstream file(folder_ / "result.json");
    return nlohmann::json::parse(file);
  }
};

TEST_F(RearSonar, PaysForItself) {
  const auto outcome = run(load("rear-sonar"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold) << outcome.summary;
  const auto checks = result()["checks"];
  ASSERT_EQ(checks.size(), 2U);
  EXPECT_EQ(checks[0]["check"], "touches of without");
  EXPECT_EQ(checks[1]["check"], "touches of with");
}

TEST_F(RearSonar, TheSuitesDifferByOneBlock) {
  const auto scenario = load("rear-sonar");
  ASSERT_EQ(scenario.groups.size(), 2U);
  config::RobotFile without = scenario.groups[0].robot;
  config::RobotFile with = scenario.groups[1].robot;
  ASSERT_EQ(with.sensors.size(), without.sensors.size() + 1);
  std::erase_if(with.sensors, [](const auto& sensor) { return *sensor.name == "rear_sonar"; });
  without.description = with.description = "";
  const auto text = [](const config::RobotFile& robot) { return config::write_robot(robot); };
  EXPECT_EQ(text(with), text(without));
}

TEST_F(RearSonar, ACheckThatFailsIsTold) {
  auto scenario = load("rear-sonar");
  scenario.scenario.duration_s = 60;
  scenario.scenario.checks.touches.at(0).most = 0;
  scenario.scenario.checks.touches.at(0).least = 0;
  scenario.scenario.checks.arrivals.push_back({{"without", {}}, -100, 0, 0.5, std::nullopt});
  const auto outcome = run(scenario);
  EXPECT_FALSE(outcome.checks_hold);
  ASSERT_GE(outcome.problems.size(), 2U);
  EXPECT_NE(outcome.problems[0].find("touches of without"), std::string::npos)
      << outcome.problems[0];
  EXPECT_NE(outcome.problems[1].find("came no nearer than"), std::string::npos)
      << outcome.problems[1];
}

}  // namespace
}  // namespace rave::tests
