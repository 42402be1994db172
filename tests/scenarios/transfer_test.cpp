// SPDX-License-Identifier: Apache-2.0
// One program binary, two robots: what is loaded is what the robot file names.
#include <fstream>
#include <set>

#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class Transfer : public ScenarioTest {
 protected:
  /// Plug-ins that are mapped into this process right now.
  static std::set<std::string> mapped_plugins() {
    std::set<std::string> names;
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) {
      const std::size_t at = line.find("/lib/rave/plugins/");
      if (at != std::string::npos) names.insert(line.substr(at + 18));
    }
    return names;
  }

  std::set<std::string> loaded_by(std::string_view robot) {
    const std::string text =
        std::string("name: transfer\nduration_s: 1\nrobots:\n  - {name: it, file: ") +
        RAVE_SOURCE_DIR + "/robots/" + std::string(robot) + ".yaml, pose: {x_m: 0, y_m: 0}}\n";
    const auto scenario = config::expand_scenario_text(text, folder_ / "transfer.yaml");
    EXPECT_TRUE(scenario) << (scenario ? "" : scenario.error().text());
    if (!scenario) return {};
    const auto world = make_world(*scenario);
    EXPECT_TRUE(world.engine);
    if (world.engine) world.run_until(1);
    return mapped_plugins();
  }
};

TEST_F(Transfer, TheSameProgramDrivesASimulatedAndARecordedRobot) {
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "with the thread sanitizer plug-ins stay loaded once they were looked at";
#endif
  ASSERT_TRUE(mapped_plugins().empty());
  const auto simulated = loaded_by("wanderer");
  ASSERT_TRUE(mapped_plugins().empty()) << "the first world must be gone before the second";
  const auto recorded = loaded_by("recorded-create");
  EXPECT_EQ(simulated,
            (std::set<std::string>{"differential_drive.so", "velocity.so", "virtual_contact.so",
                                   "virtual_laser.so", "wander.so"}));
  EXPECT_EQ(recorded,
            (std::set<std::string>{"replay_ignored.so", "utias_camera.so", "utias_mocap.so",
                                   "utias_odometry.so", "velocity.so", "virtual_landmark_camera.so",
                                   "virtual_laser.so", "wander.so"}));
}

}  // namespace
}  // namespace rave::tests
