// SPDX-License-Identifier: Apache-2.0
// A record played back gives what was recorded, to the bit.
#include <gtest/gtest.h>

#include <fstream>

#include "process.hpp"
#include "rave/run_testing/recorded_run.hpp"

namespace rave::cli_test {
namespace {

/// Runs a scenario and leaves its record in `folder`.
void record_run(const std::string& scenario, const std::string& folder,
                const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"run", scenario, "--output", folder, "--no-picture"};
  words.insert(words.end(), more.begin(), more.end());
  const Ended ended = run_rave(words);
  ASSERT_NE(ended.exit_code, 2) << ended.err;
}

void expect_same_readings(const Readings& original, const Readings& played) {
  for (const auto& [sensor, readings] : original) {
    const auto found = played.find(sensor);
    ASSERT_NE(found, played.end()) << sensor;
    ASSERT_EQ(found->second.size(), readings.size()) << sensor;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      ASSERT_EQ(found->second[i], readings[i]) << sensor << ", reading " << i;
    }
  }
}

TEST(Play, EveryReadingOfVirtualSensorsComesBackBitForBit) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original);
  const std::string first = folder.path() / "first";
  const Ended played = run_rave(
      {"play", original, "--program", "wander", "--output", first, "--no-picture", "--quiet"});
  ASSERT_EQ(played.exit_code, 0) << played.err;
  const Readings recorded = readings_of(original + "/run.mcap");
  ASSERT_EQ(recorded.size(), 11U);
  std::size_t readings = 0;
  for (const auto& [sensor, list] : recorded) readings += list.size();
  EXPECT_GT(readings, 1000U);
  expect_same_readings(recorded, readings_of(first + "/run.mcap"));

  const std::string second = folder.path() / "second";
  ASSERT_EQ(run_rave({"play", original, "--program", "wander", "--output", second, "--quiet",
                      "--no-picture", "--threads", "2"})
                .exit_code,
            0);
  EXPECT_EQ(hash_of(first + "/run.mcap"), hash_of(second + "/run.mcap"));
  EXPECT_EQ(run_rave({"verify", first}).exit_code, 0);
}

TEST(Play, SoDoThoseOfARecordingThatWasPlayedBefore) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("../../../scenarios/mixed-reality", original, {"--duration", "6"});
  const std::string again = folder.path() / "again";
  ASSERT_EQ(run_rave({"play", original, "--robot", "real-1", "--robot", "real-4", "--program",
                      "wander", "--output", again, "--no-picture", "--quiet"})
                .exit_code,
            0);
  Readings recorded = readings_of(original + "/run.mcap");
  std::erase_if(recorded, [](const auto& entry) {
    return !entry.first.starts_with("real-1/") && !entry.first.starts_with("real-4/");
  });
  ASSERT_EQ(recorded.size(), 10U);
  EXPECT_FALSE(recorded["real-1/camera"].empty());
  expect_same_readings(recorded, readings_of(again + "/run.mcap"));
}

TEST(Play, StandsWhereItStoodFromTheStartThatIsAskedFor) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original);
  const std::string later = folder.path() / "later";
  ASSERT_EQ(
      run_rave({"play", original, "--start", "1.5", "--output", later, "--no-picture", "--quiet"})
          .exit_code,
      0);
  const auto before = record::McapReader::open(original + "/run.mcap");
  const auto after = record::McapReader::open(later + "/run.mcap");
  ASSERT_TRUE(before && after);
  for (const std::uint32_t robot : {0U, 1U}) {
    const auto then = record::read_poses(*before, RobotId(robot));
    const auto now = record::read_poses(*after, RobotId(robot));
    ASSERT_TRUE(then && now);
    ASSERT_EQ(now->size(), 250U);
    for (std::size_t i = 0; i < now->size(); ++i) {
      ASSERT_FALSE((*now)[i].true_pose);
      ASSERT_TRUE((*now)[i].reported_pose);
      // The frame of anna's odometry went through degrees.
      EXPECT_NEAR((*now)[i].reported_pose->x, (*then)[i + 150].reported_pose->x, 1e-12);
      EXPECT_NEAR((*now)[i].reported_pose->y, (*then)[i + 150].reported_pose->y, 1e-12);
      EXPECT_NEAR((*now)[i].reported_pose->yaw, (*then)[i + 150].reported_pose->yaw, 1e-12);
    }
  }
}

TEST(Play, WhatIsWrittenTakesSimulatedRobotsByHand) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original);
  const std::string written = folder.path() / "mine";
  ASSERT_EQ(
      run_rave({"play", original, "--robot", "bert", "--anew", "front_laser", "--write", written})
          .exit_code,
      0);
  std::string text = content_of(written + "/scenario.yaml");
  const std::size_t robots = text.find("\nrobots:\n");
  ASSERT_NE(robots, std::string::npos);
  text.insert(robots + 9, "  - {name: carl, file: " RAVE_SOURCE_DIR
                          "/tests/cli/data/good_robot.yaml, pose: {x_m: 2.2, y_m: -1}}\n");
  std::ofstream(written + "/scenario.yaml") << text;
  const std::string mixed = folder.path() / "mixed";
  record_run(written, mixed);
  const Readings now = readings_of(mixed + "/run.mcap");
  const Readings then = readings_of(original + "/run.mcap");
  EXPECT_EQ(now.at("bert/rear_sonar"), then.at("bert/rear_sonar"));
  EXPECT_NE(now.at("bert/front_laser"), then.at("bert/front_laser"))
      << "bert's laser was to sense carl";
  EXPECT_TRUE(now.contains("carl/front_laser"));

  const Ended twice = run_rave({"play", original, "--write", written});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("already contains a scenario"), std::string::npos) << twice.err;
}

/// What a played laser had sensed is a wall of the real floor for a hybrid sensor beside it.
TEST(Play, WrittenObstaclesAreThoseThatThePlayedSensorsSaw) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original, {"--duration", "0.5"});
  ASSERT_NE(content_of(original + "/scenario.yaml").find("virtual_obstacles"), std::string::npos);
  const std::string written = folder.path() / "mine";
  const Ended ended = run_rave({"play", original, "--write", written});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("note: obstacles have the layer `mapped_real`"), std::string::npos)
      << ended.err;
  const std::string world = content_of(written + "/world.yaml");
  EXPECT_EQ(world.find("virtual_obstacles"), std::string::npos) << world;
  EXPECT_NE(world.find("mapped_real"), std::string::npos) << world;
}

TEST(Play, WhatIsWrittenMovesTogetherWithItsRecording) {
  const TemporaryFolder folder;
  const std::string before = folder.path() / "before";
  const std::string after = folder.path() / "after";
  record_run("played.yaml", before + "/original", {"--duration", "0.5"});
  ASSERT_EQ(run_rave({"play", before + "/original", "--write", before + "/mine"}).exit_code, 0);
  EXPECT_EQ(content_of(before + "/mine/robots/anna.yaml").find(folder.path()), std::string::npos)
      << "an absolute path";
  std::filesystem::rename(before, after);
  const Ended ended =
      run_rave({"run", after + "/mine", "--output", after + "/run", "--no-picture", "--quiet"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  // A run that makes the scenario in its own folder can be moved as well.
  ASSERT_EQ(run_rave({"play", after + "/original", "--output", after + "/again", "--no-picture",
                      "--quiet"})
                .exit_code,
            0);
  EXPECT_EQ(content_of(after + "/again/played/robots/anna.yaml").find(folder.path()),
            std::string::npos);
}

/// The halves of a hybrid and the devices of hardware are gone: only results are played.
TEST(Play, HybridsArePlayedAsOneSensor) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("../../../scenarios/hybrid-laser", original, {"--duration", "2"});
  const std::string again = folder.path() / "again";
  const Ended ended = run_rave(
      {"play", original, "--robot", "freiburg", "--output", again, "--no-picture", "--quiet"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  Readings recorded = readings_of(original + "/run.mcap");
  std::erase_if(recorded, [](const auto& e) { return !e.first.starts_with("freiburg/"); });
  EXPECT_FALSE(recorded["freiburg/laser"].empty());
  expect_same_readings(recorded, readings_of(again + "/run.mcap"));
  const std::string robot = content_of(again + "/played/robots/freiburg.yaml");
  EXPECT_EQ(robot.find("hybrid_ranges"), std::string::npos) << robot;
}

TEST(Play, WhatIsNotThereIsNamedWithWhatIsNear) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original, {"--duration", "0.5"});
  const auto error = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"play", original});
    const Ended ended = run_rave(words);
    EXPECT_EQ(ended.exit_code, 2);
    return ended.err;
  };
  EXPECT_EQ(error({"--robot", "ana"}),
            "rave: the recording has no robot `ana`; did you mean `anna`?\n");
  EXPECT_EQ(error({"--anew", "lazer"}),
            "rave: no played robot has a sensor `lazer`; did you mean `laser`?\n");
  EXPECT_NE(error({"--start", "9"}).find("the recording is 0.5 s long"), std::string::npos);
  EXPECT_NE(error({"--world", "nowhere.yaml"}).find("nowhere.yaml"), std::string::npos);
  EXPECT_EQ(run_rave({"play", "good_world.yaml"}).exit_code, 2);
}

TEST(Play, ARobotFileThatNamesTheWrongThingIsToldSo) {
  const TemporaryFolder folder;
  const std::string original = folder.path() / "original";
  record_run("played.yaml", original, {"--duration", "0.5"});
  const auto error = [&](const std::string& driver, const std::string& params) {
    std::ofstream(folder.path() / "robot.yaml")
        << "body: {shapes: [{disc_radius_m: 0.2, z_m: [0, 0.3]}]}\npose_from: it\nsensors:\n"
        << "  - {name: it, driver: " << driver << ", params: {file: original/run.mcap, " << params
        << "}}\n";
    std::ofstream(folder.path() / "scenario.yaml")
        << "name: wrong\nduration_s: 0.1\nrobots: [{name: it, file: robot.yaml}]\n";
    const Ended ended =
        run_rave({"run", folder.path() / "scenario.yaml", "--output", folder.path() / "run"});
    return fmt::format("{}: {}", ended.exit_code, ended.err);
  };
  EXPECT_NE(error("playback_pose", "robot: anna, sensor: laser")
                .find("sensor `laser` of robot `anna` gives ranges, so its driver is "
                      "`playback_ranges`, not `playback_pose`"),
            std::string::npos);
  EXPECT_NE(error("playback_pose", "robot: anna, sensor: indor").find("did you mean `indoor`?"),
            std::string::npos);
  EXPECT_TRUE(error("playback_pose", "robot: anna, sensor: indoor").starts_with("0: "));
  std::filesystem::remove(folder.path() / "original" / "run.mcap");
  EXPECT_NE(error("playback_pose", "robot: anna").find("run.mcap"), std::string::npos);
}

}  // namespace
}  // namespace rave::cli_test
