// SPDX-License-Identifier: Apache-2.0
#include "rave/config/settings.hpp"

#include <gtest/gtest.h>

#include "rave/config/any_file.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

const std::filesystem::path kSettingsData = RAVE_SOURCE_DIR "/libs/config/tests/data";

Result<ExpandedScenario> mixed_with(const std::vector<std::string>& settings) {
  return expand_scenario(kSettingsData / "scenarios/mixed.yaml", settings);
}

std::string setting_error(const std::vector<std::string>& settings) {
  const auto expanded = mixed_with(settings);
  return expanded ? "none" : expanded.error().text();
}

TEST(Settings, ReachKeysOfAllKindsOfTheScenario) {
  const auto good = mixed_with(
      {"duration_s=30", "robots.loner.pose.x_m=1.5", "robots.1.variables.barcode=17",
       "robots.prey.scatter={count: 2, x_m: [0, 1], y_m: [0, 1]}", "robots.walker.poses.1.2=45",
       "picture.instant_s=null", "geo_origin.latitude_deg=48", "geo_origin.longitude_deg=9"});
  ASSERT_TRUE(good.has_value()) << good.error().text();
  EXPECT_EQ(good->scenario.duration_s, 30);
  EXPECT_EQ(good->groups[1].robot.body->barcode, 17);
  EXPECT_EQ(good->robots[3].pose, (PoseFile{1, 0.5, 45}));
  EXPECT_EQ(good->robots[4].pose, (PoseFile{1.5, 2, 180}));
  EXPECT_EQ(good->robots.size(), 7U);
  EXPECT_FALSE(good->scenario.picture->instant_s.has_value());
  EXPECT_EQ(good->scenario.geo_origin->longitude_deg, 9);
}

TEST(Settings, ReachKeysOfTheRobotFileOfAnEntry) {
  const auto plain = mixed_with({});
  const auto changed = mixed_with({"robots.loner.robot.body.mass_kg=4",
                                   "robots.loner.robot.sensors.laser.params.rays=90",
                                   "robots.loner.variables.range=3"});
  ASSERT_TRUE(plain.has_value());
  ASSERT_TRUE(changed.has_value()) << changed.error().text();
  EXPECT_EQ(changed->groups[3].robot.body->mass_kg, 4);
  const RawNode& params = changed->groups[3].robot.sensors[0].params;
  EXPECT_EQ(params.find("rays")->as_int(), 90);
  EXPECT_EQ(params.find("range_m")->as_double(), 3);
  // The file is still the base of relative paths, and other entries with it have its values.
  EXPECT_EQ(changed->groups[3].file, plain->groups[3].file);
  EXPECT_EQ(changed->groups[2], plain->groups[2]);
}

TEST(Settings, OfAKeyWithDotsIsThatKey) {
  const std::string change = "changes=[{at_s: 1, robot: loner, set: {program.speed_mps: 0.1}}]";
  const auto expanded = mixed_with({change, "changes.0.set.program.speed_mps=0.2"});
  ASSERT_TRUE(expanded.has_value()) << expanded.error().text();
  const RawNode& set = *expanded->scenario.changes[0].set;
  EXPECT_EQ(set.size(), 1U);
  EXPECT_EQ(set.find("program.speed_mps")->as_double(), 0.2);
}

TEST(Settings, AreInTheExpandedScenario) {
  const auto changed = mixed_with({"robots.loner.robot.body.mass_kg=4", "seed=99"});
  ASSERT_TRUE(changed.has_value()) << changed.error().text();
  const auto again =
      expand_scenario_text(write_expanded(*changed), kSettingsData / "elsewhere.yaml");
  ASSERT_TRUE(again.has_value()) << again.error().text();
  EXPECT_EQ(again->scenario.seed, 99U);
  EXPECT_EQ(again->groups[3].robot.body->mass_kg, 4);
}

TEST(Settings, ErrorsNameTheOptionWhatWasExpectedAndTheNearestKey) {
  const std::pair<const char*, const char*> cases[] = {
      {"duration_s=long",
       "--set duration_s=long: `duration_s`: found the text \"long\", expected a number (greater "
       "than 0 and at most 1000000000, in seconds), or `none`"},
      {"duraton_s=3", "--set duraton_s=3: unknown key `duraton_s`; did you mean `duration_s`?"},
      {"robots.loner.poze.x_m=3",
       "--set robots.loner.poze.x_m=3: unknown key `poze`; did you mean `pose`?"},
      {"robots.lonerr.pose.x_m=3",
       "--set robots.lonerr.pose.x_m=3: there is no item `lonerr`; expected a name or 0 to 4; did "
       "you "
       "mean `loner`?"},
      {"robots.walker.poses.2.0=3",
       "--set robots.walker.poses.2.0=3: there is no item `2`; expected a name or 0 to 1"},
      {"robots.loner.variables.rnge=3",
       "--set robots.loner.variables.rnge=3: unknown variable `rnge`; the robot file declares "
       "range and colour"},
      {"robots.loner.robot.body.mas_kg=3",
       "--set robots.loner.robot.body.mas_kg=3: unknown key `mas_kg`; did you mean `mass_kg`?"},
      {"seed.x=3", "--set seed.x=3: `seed` has no keys: found the number 7"},
      {"seed", "--set seed: expected KEY=VALUE, such as `robots.prey.pose.x_m=1.5`"},
      {"seed=", "--set seed=: expected KEY=VALUE, such as `robots.prey.pose.x_m=1.5`"},
      {"=3", "--set =3: expected KEY=VALUE, such as `robots.prey.pose.x_m=1.5`"},
      {"robots..pose=3", "--set robots..pose=3: `robots..pose` has an empty name"},
      {"seed.=3", "--set seed.=3: nothing follows the last dot of `seed.`"},
  };
  for (const auto& [setting, error] : cases) {
    EXPECT_EQ(setting_error({setting}), error);
  }
  EXPECT_TRUE(
      setting_error({"description=a: b"}).starts_with("--set description=a: b: the value: "));
  EXPECT_EQ(setting_error({"description=a\nseed: 3"}),
            "--set description=a\nseed: 3: the value: expected one line");
  EXPECT_TRUE(setting_error({"seed=[3"}).starts_with("--set seed=[3: the value: "));
  const std::vector<std::string> one = {"seed=3"};
  const auto robot = read_any_file(kSettingsData / "robots/walker.yaml", one);
  ASSERT_FALSE(robot.has_value());
  EXPECT_NE(robot.error().message.find("--set: expected a scenario, but"), std::string::npos);
}

}  // namespace
}  // namespace rave::config
