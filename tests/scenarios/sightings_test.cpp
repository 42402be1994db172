// SPDX-License-Identifier: Apache-2.0
// The sighting check on the shipped recordings: that it holds, and that it notices the two
// classical mistakes with such data.
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "rave/record/record_summary.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class Sightings : public ScenarioTest {
 protected:
  /// Sets a parameter of a sensor of every robot that has it.
  static void set_param(config::ExpandedScenario& scenario, std::string_view sensor,
                        std::string_view param, const codec::RawNode& value) {
    int found = 0;
    for (config::RobotGroup& group : scenario.groups) {
      for (config::SensorFile& file : group.robot.sensors) {
        if (file.name.value != sensor) continue;
        file.params.set(param, value);
        ++found;
      }
    }
    ASSERT_GT(found, 0);
  }

  nlohmann::json result() const {
    std::ifstream file(folder_ / "result.json");
    return nlohmann::json::parse(file);
  }
};

TEST_F(Sightings, TheVirtualCameraConfirmsTheRealOnes) {
  const auto outcome = run(load("mixed-reality"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold);
  const auto json = result();
  EXPECT_EQ(json["sightings"]["total"], 2547);
  EXPECT_EQ(json["sightings"]["unknown"], 3);
  EXPECT_GE(json["sightings"]["within_pct"], 99.0);
  ASSERT_EQ(json["sightings"]["robots"].size(), 5U);
  std::uint64_t sum = 0;
  for (const auto& [name, tally] : json["sightings"]["robots"].items()) {
    sum += tally["total"].get<std::uint64_t>();
    EXPECT_GE(tally["within_pct"], 95.0) << name;
  }
  EXPECT_EQ(sum, 2547U);
}

TEST_F(Sightings, AClockThatIsOneSecondOffIsNoticed) {
  auto scenario = load("mixed-reality");
  set_param(scenario, "camera", "clock_offset_s", codec::RawNode::number(1.0));
  const auto outcome = run(scenario);
  EXPECT_FALSE(outcome.checks_hold);
  const auto within = result()["sightings"]["within_pct"].get<double>();
  EXPECT_GT(within, 60) << "the recording gives about 75 %";
  EXPECT_LT(within, 85);
  ASSERT_FALSE(outcome.problems.empty());
  EXPECT_NE(outcome.problems.front().find("the sighting check fails"), std::string::npos);
}

TEST_F(Sightings, CodesReadAsSubjectsAreNoticed) {
  auto scenario = load("mixed-reality");
  set_param(scenario, "camera", "codes", codec::RawNode::text("subject"));
  const auto outcome = run(scenario);
  EXPECT_FALSE(outcome.checks_hold);
  EXPECT_LT(result()["sightings"]["within_pct"].get<double>(), 40);
}

TEST_F(Sightings, HoldsOnTheOtherStretchToo) {
  const auto outcome = run(load("lost-and-found"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold);
  const auto json = result();
  EXPECT_GE(json["events"]["pose_stale"], 1) << "robot 1 loses its pose";
  const auto& touch = json["closest"]["real-real"];
  EXPECT_NEAR(touch["centres_m"].get<double>(), 0.33, 0.002);
  EXPECT_NEAR(touch["time_s"].get<double>(), 81.2, 0.2);
}

/// The same recording by the clock on the wall: nothing promises that it can be repeated, so no
/// hash is printed, and the run says why.
TEST_F(Sightings, ARecordingCanPlayInRealTime) {
  auto scenario = load("mixed-reality");
  for (const char* sensor : {"mocap", "commanded", "camera"}) {
    set_param(scenario, sensor, "clock", codec::RawNode::text("live"));
  }
  scenario.scenario.duration_s = 2;
  scenario.scenario.picture.reset();
  scenario.scenario.checks.sightings.reset();
  scenario.scenario.max_missed_pct = 100;  // however busy the machine is
  const auto begin = std::chrono::steady_clock::now();
  const auto outcome = run(scenario);
  // The last step is due at 1.99 s, however busy the machine is.
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(1990));
  EXPECT_TRUE(outcome.whole) << (outcome.problems.empty() ? "" : outcome.problems.front());
  EXPECT_TRUE(outcome.hash.empty());
  const auto json = result();
  EXPECT_TRUE(json["hash"].is_null());
  EXPECT_NE(json["no_hash_because"].get<std::string>().find("wall clock"), std::string::npos);
  for (std::size_t r = 0; r < 5; ++r) {
    EXPECT_GT(json["robots"][r]["final_pose"]["stamp_s"], 1.5) << "poses kept coming";
  }
}

TEST_F(Sightings, TheRunLeavesEverythingInOneFolder) {
  const auto outcome = run(load("mixed-reality"), true);
  for (const char* file : {"result.json", "summary.txt", "events.log", "scenario.yaml",
                           "picture.svg", "picture.png", "run.mcap"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;
  }
  const auto json = result();
  EXPECT_EQ(json["hash"], outcome.hash);
  EXPECT_EQ(json["hash"].get<std::string>().size(), 16U);
  ASSERT_EQ(json["streams"].size(), 15U) << "three streams of five robots";
  for (const auto& stream : json["streams"]) {
    for (const char* field : {"robot", "sensor", "sha256", "start_s", "end_s", "first_stamp_s",
                              "last_stamp_s", "rate_hz", "gaps", "largest_age_s", "repairs"}) {
      EXPECT_TRUE(stream.contains(field)) << field;
    }
    EXPECT_EQ(stream["sha256"].get<std::string>().size(), 64U);
  }
  for (const char* pair : {"real-real", "real-simulated", "simulated-simulated"}) {
    ASSERT_TRUE(json["closest"].contains(pair)) << pair;
    EXPECT_TRUE(json["closest"][pair].contains("time_s"));
  }
  EXPECT_GT(json["hits"]["real"]["simulated"], 0) << "recorded robots sense simulated ones";
  EXPECT_GT(json["hits"]["simulated"]["real"], 0) << "and the other way round";
  EXPECT_GT(json["hits"]["real"]["virtual_obstacle"], 0);
  const auto record = record::describe_record(folder_ / "run.mcap", record::RecordLook::kAll);
  ASSERT_TRUE(record) << record.error().text();
  EXPECT_TRUE(record->checked);
  EXPECT_TRUE(record->damages.empty() && record->unsummed.empty());
  ASSERT_TRUE(record->end && record->end->hash);
  EXPECT_EQ(fmt::format("{:016x}", *record->end->hash), outcome.hash);
  EXPECT_EQ(record->end->steps, 12000U);
  // What was run can be run again from what it left.
  const auto again = config::expand_scenario(folder_ / "scenario.yaml");
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(*again, load("mixed-reality"));
}

}  // namespace
}  // namespace rave::tests
