// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

constexpr const char* kScenario = R"(
name: a
robots:
  - name: r
    variables: {base: "{work}/base"}
    robot:
      variables: {base: none}
      body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]}
      devices: [{name: d, driver: create_oi, params: {device: $(base), list: ["a {work} b"]}}]
companions:
  - name: bridge
    command: [./bridge, --room, "{scenario}/room.txt", --link, "{work}/base"]
    environment: {PORT: 9763, FOLDER: "{work}"}
    ready: listening
    on_end: end_run
  - {name: other, command: [sleep, "5"]}
)";

TEST(Companions, HaveAbsolutePaths) {
  const auto scenario = expand_scenario_text(kScenario, "/lab/a/scenario.yaml");
  ASSERT_TRUE(scenario.has_value()) << scenario.error().text();
  const auto& companions = scenario->scenario.companions;
  ASSERT_EQ(companions.size(), 2U);
  EXPECT_EQ(*companions[0].command,
            (std::vector<std::string>{"/lab/a/bridge", "--room", "/lab/a/room.txt", "--link",
                                      "{work}/base"}));
  EXPECT_EQ(companions[0].on_end, CompanionEnd::kEndRun);
  // A name alone is looked for when the run starts.
  EXPECT_EQ(companions[1].command->front(), "sleep");
  EXPECT_EQ(companions[1].on_end, CompanionEnd::kIgnore);
}

TEST(Companions, ShareAFolderThatRobotsKnow) {
  auto scenario = expand_scenario_text(kScenario, "/lab/a/scenario.yaml");
  ASSERT_TRUE(scenario.has_value()) << scenario.error().text();
  set_work_folder(*scenario, "/runs/1/companions");
  const CompanionFile& bridge = scenario->scenario.companions[0];
  EXPECT_EQ(bridge.command->back(), "/runs/1/companions/base");
  EXPECT_EQ(bridge.environment.at("FOLDER").scalar(), "/runs/1/companions");
  EXPECT_EQ(bridge.environment.at("PORT").scalar(), "9763");
  const RawNode& params = scenario->groups[0].robot.devices[0].params;
  EXPECT_EQ(params.find("device")->scalar(), "/runs/1/companions/base");
  EXPECT_EQ(params.find("list")->child(0).scalar(), "a /runs/1/companions b");
  // Errors are still reported where it was written.
  EXPECT_EQ(params.find("device")->where().line, 9);
}

TEST(Companions, AreWrittenAndReadAgain) {
  const auto scenario = expand_scenario_text(kScenario, "/lab/a/scenario.yaml");
  ASSERT_TRUE(scenario.has_value()) << scenario.error().text();
  const auto again = expand_scenario_text(write_expanded(*scenario), "/elsewhere/b.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(again->scenario.companions, scenario->scenario.companions);
}

}  // namespace
}  // namespace rave::config
