// SPDX-License-Identifier: Apache-2.0
#include "rave/host/run.hpp"

#include <nlohmann/json.hpp>

#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/base/file.hpp"
#include "rave/results/goal_checks.hpp"

namespace rave::runtime::testing {
namespace {

using Json = nlohmann::json;

/// Runs a scenario into a folder of its own; gives what result.json says.
Json result_of(const std::string& text, const std::string& name, RunOutcome& outcome) {
  Host host;
  const auto scenario = host.expand(text);
  if (!scenario) {
    ADD_FAILURE() << scenario.error().text();
    return {};
  }
  RunOptions options;
  options.output = std::filesystem::path(::testing::TempDir()) / ("rave_run_" + name);
  std::filesystem::remove_all(options.output);
  options.picture = false;
  const auto run_outcome = run(*scenario, host.catalogue(), options);
  if (!run_outcome) {
    ADD_FAILURE() << run_outcome.error().text();
    return {};
  }
  outcome = *run_outcome;
  for (const char* const file : {"summary.txt", "events.log", "scenario.yaml"}) {
    EXPECT_TRUE(std::filesystem::exists(options.output / file)) << file;
  }
  const auto json = read_file(options.output / "result.json");
  EXPECT_TRUE(json.has_value());
  std::filesystem::remove_all(options.output);
  return Json::parse(json.value_or("{}"));
}

TEST(Run, AHandOverThatTheEndCutsOffIsAProblem) {
  RunOutcome outcome;
  const Json result = result_of(
      "name: cut\nduration_s: 1\nstep_s: 0.01\npace: max\n"
      "changes:\n  - {at_s: 0.99, robot: anna, hand_over: twin}\n"
      "robots:\n  - {name: anna, file: ../robots/wanderer.yaml, twin: ../robots/wanderer.yaml, "
      "pose: {x_m: 0, y_m: 0}}\n",
      "cut", outcome);
  EXPECT_FALSE(outcome.whole);
  ASSERT_EQ(outcome.problems.size(), 1U);
  EXPECT_NE(outcome.problems[0].find("robot `anna` at 1.00 s was not handed over: simulated -> "
                                     "simulated: the run ended before the hand-over"),
            std::string::npos)
      << outcome.problems[0];
  ASSERT_EQ(result.at("hand_overs").size(), 1U);
  EXPECT_EQ(result.at("hand_overs")[0].at("made"), false);
}

TEST(Run, ResultHasEverythingThatAnExperimenterNeeds) {
  RunOutcome outcome;
  const Json result = result_of(
      "name: recorded\nduration_s: 45\nworld: ../worlds/utias.yaml\npace: max\nrobots:\n"
      "  - {name: real-1, file: ../robots/recorded-create.yaml, variables: {robot: 1, barcode: 5}, "
      "pose: {x_m: 0.66, y_m: 1.4}}\n"
      "  - {name: walker, file: ../robots/wanderer.yaml, scatter: {count: 3, x_m: [0.3, 4.6], y_m: "
      "[-3.2, 4.6], clearance_m: 0.35}}\n"
      "checks:\n  sightings: {real: camera, twin: camera_twin, min_within_pct: 80}\n",
      "full", outcome);
  EXPECT_EQ(result.at("scenario"), "recorded");
  EXPECT_EQ(result.at("whole"), outcome.whole);
  EXPECT_TRUE(outcome.whole) << result.at("problems");
  EXPECT_EQ(result.at("steps"), 4500);
  EXPECT_EQ(result.at("hash"), outcome.hash);
  EXPECT_EQ(outcome.hash.size(), 16U);
  const Json& sightings = result.at("sightings");
  EXPECT_GT(sightings.at("total"), 0);
  EXPECT_TRUE(sightings.contains("unknown"));
  EXPECT_GT(sightings.at("within_pct"), 80);
  EXPECT_TRUE(sightings.at("unknown_codes").is_array());
  EXPECT_EQ(sightings.at("robots").at("real-1").at("total"), sightings.at("total"));
  EXPECT_TRUE(result.at("hits").contains("real"));
  EXPECT_TRUE(result.at("hits").contains("simulated"));
  for (const auto& [pair, closest] : result.at("closest").items()) {
    EXPECT_TRUE(closest.contains("gap_m") && closest.contains("time_s")) << pair;
  }
  EXPECT_TRUE(result.at("closest").contains("real-landmark"));
  ASSERT_EQ(result.at("streams").size(), 3U);
  for (const Json& stream : result.at("streams")) {
    EXPECT_EQ(stream.at("robot"), "real-1");
    for (const char* const key : {"sha256", "first_stamp_s", "last_stamp_s", "rate_hz", "gaps",
                                  "largest_age_s", "repairs", "start_s", "end_s"}) {
      EXPECT_TRUE(stream.contains(key)) << stream.at("sensor") << " lacks " << key << "\n"
                                        << stream;
    }
  }
  ASSERT_EQ(result.at("robots").size(), 4U);
  EXPECT_FALSE(result.at("robots").at(0).at("obeys"));
  EXPECT_TRUE(result.at("robots").at(1).at("obeys"));
}

TEST(Run, GivesTheSameHashForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  const auto hash = [](const std::string& settings) {
    RunOutcome outcome;
    result_of("name: crowd\nduration_s: 3\npace: max\n" + settings +
                  "robots:\n  - {name: walker, file: ../robots/wanderer.yaml, scatter: {count: 70, "
                  "x_m: [0, 6], y_m: [0, 6]}}\n",
              "hash", outcome);
    EXPECT_TRUE(outcome.whole);
    return outcome.hash;
  };
  const std::string one = hash("threads: 1\n");
  EXPECT_EQ(hash("threads: 3\n"), one);
  EXPECT_NE(hash("seed: 2\n"), one);
}

/// A bumper that says nothing touches nothing, which is not what the check asks.
TEST(Run, TouchesOfASensorThatNeverGaveAReadingAreNotCounted) {
  for (const bool silent : {true, false}) {
    RunOutcome outcome;
    const Json result = result_of(
        fmt::format(
            "name: bumpers\nduration_s: 0.5\npace: max\n"
            "checks: {{touches: [{{robots: [anna], sensor: bumper, most: 3}}]}}\n"
            "robots:\n  - {{name: anna, pose: {{x_m: 0, y_m: 0}}, robot: {{{}, {}, sensors: "
            "[{{name: bumper, driver: virtual_contact, period_s: 1, phase_s: {}}}]}}}}\n",
            kBody, kWheels, silent ? 0.9 : 0.1),
        "bumpers", outcome);
    EXPECT_EQ(outcome.checks_hold, !silent);
    const Json& check = result.at("checks").at(0);
    if (silent) {
      EXPECT_EQ(check.at("holds"), nullptr);
      EXPECT_EQ(check.at("text"), "not evaluated: `bumper` of `anna` never gave a reading");
    } else {
      EXPECT_EQ(check.at("holds"), true);
    }
  }
}

/// Whoever is nowhere touches nothing.
TEST(Run, ContactsOfARobotWhosePlaceWasNeverKnownAreNotCounted) {
  for (const bool late : {true, false}) {
    RunOutcome outcome;
    const Json result = result_of(
        fmt::format("name: nowhere\nduration_s: 0.1\npace: max\n"
                    "checks: {{touches: [{{robots: [real-1]}}]}}\nrobots:\n  - {{name: real-1, "
                    "robot: {{{}, pose_from: mocap, sensors: [{{name: mocap, driver: utias_mocap, "
                    "params: {{folder: {}/data/utias-mrclam6/100-220, robot: 1, "
                    "clock_offset_s: {}}}}}]}}}}\n",
                    kBody, RAVE_SOURCE_DIR, late ? 5 : 0),
        "nowhere", outcome);
    EXPECT_EQ(outcome.checks_hold, !late);
    EXPECT_EQ(
        result.at("checks").at(0).at("text"),
        late ? "not evaluated: the place of `real-1` was never known" : "0, expected at most 0");
  }
}

TEST(Run, ContactsOfBeforeAManagerTookOverAreNotTakenForNone) {
  Host host;
  const std::string text = fmt::format(
      "name: late\nduration_s: 1\nchecks: {{touches: [{{robots: [anna]}}]}}\nrobots:\n"
      "  - {{name: anna, pose: {{x_m: 0, y_m: 0}}, robot: {{{}, {}}}}}\n",
      kBody, kWheels);
  const auto scenario = host.expand(text);
  ASSERT_TRUE(scenario) << scenario.error().text();
  const auto built = host.build_text(text);
  ASSERT_TRUE(built) << built.error().text();
  RunFacts facts;
  facts.steps = 100;
  facts.has_world = true;
  auto results = goal_results(*scenario, built->spec, facts, {});
  ASSERT_EQ(results.size(), 1U);
  EXPECT_TRUE(results[0].holds && results[0].made);
  facts.world_from = 5;
  results = goal_results(*scenario, built->spec, facts, {});
  EXPECT_FALSE(results[0].holds);
  EXPECT_FALSE(results[0].made);
  EXPECT_EQ(results[0].text,
            "not evaluated: contacts before step 5 are known only to the previous manager");
}

/// Asks for the end of the run after so many steps, as a signal does.
class EndsAfter final : public RunObserver {
 public:
  EndsAfter(std::uint64_t steps, RunControl& control) : steps_(steps), control_(control) {}
  void after_step(const StepView& step) override {
    if (step.engine.steps_done() == steps_) control_.stop();
  }

 private:
  std::uint64_t steps_;
  RunControl& control_;
};

/// A run that is ended at 0.3 s, with these checks of a robot that stands.
RunOutcome ended_by_hand(const std::string& checks, Json& result,
                         const std::string& duration_s = "1") {
  Host host;
  const auto scenario = host.expand(
      fmt::format("name: ended\nduration_s: {}\nstep_s: 0.01\npace: max\npicture: {{}}\nchecks: "
                  "{{{}}}\nrobots:\n"
                  "  - {{name: anna, pose: {{x_m: 0, y_m: 0}}, robot: {{{}, {}}}}}\n",
                  duration_s, checks, kBody, kWheels));
  EXPECT_TRUE(scenario) << scenario.error().text();
  RunControl control;
  EndsAfter ends(30, control);
  RunOptions options;
  options.output = std::filesystem::path(::testing::TempDir()) / "rave_run_ended";
  options.picture = false;
  options.control = &control;
  options.observers = {&ends};
  const auto outcome = run(*scenario, host.catalogue(), options);
  EXPECT_TRUE(outcome) << outcome.error().text();
  result = Json::parse(read_file(options.output / "result.json").value_or("{}"));
  std::filesystem::remove_all(options.output);
  return outcome.value_or(RunOutcome());
}

TEST(Run, AnEndByHandIsAnEndAndChecksThatHadTimeLeftHaveNotFailed) {
  Json result;
  const RunOutcome outcome = ended_by_hand(
      "arrivals: [{robot: anna, x_m: 5, y_m: 0, within_m: 1}, {robot: anna, x_m: 5, y_m: 0, "
      "within_m: 1, before_s: 0.9}], touches: [{robots: [anna]}]",
      result);
  EXPECT_TRUE(outcome.whole && outcome.good()) << outcome.summary;
  EXPECT_FALSE(outcome.checks_hold || outcome.checks_fail);
  ASSERT_TRUE(outcome.ended_by_hand_s);
  EXPECT_NEAR(*outcome.ended_by_hand_s, 0.3, 1e-9);
  EXPECT_EQ(result.at("whole"), true);
  EXPECT_NEAR(result.at("ended_by_hand_s").get<double>(), 0.3, 1e-9);
  EXPECT_EQ(outcome.hash.size(), 16U);
  EXPECT_NE(outcome.summary.find("at 0.30 s"), std::string::npos) << outcome.summary;
  const Json checks = result.at("checks");
  ASSERT_EQ(checks.size(), 3U);
  EXPECT_EQ(checks[0].at("holds"), true) << "no touch so far: " << checks.dump();
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_TRUE(checks[i].at("holds").is_null()) << checks.dump();
    EXPECT_NE(
        checks[i].at("text").dump().find("not evaluated: the run was ended by hand at 0.30 s"),
        std::string::npos)
        << checks.dump();
  }
}

TEST(Run, AnOpenEndHasTheHashOfTheSameStepsAndIsComplete) {
  Json open;
  Json planned;
  const RunOutcome outcome = ended_by_hand("", open, "none");
  EXPECT_TRUE(outcome.good() && outcome.problems.empty()) << outcome.summary;
  EXPECT_NEAR(outcome.ended_by_hand_s.value_or(0), 0.3, 1e-9);
  EXPECT_EQ(outcome.hash, ended_by_hand("", planned).hash);
}

TEST(Run, AnEndByHandHidesNoCheckThatFails) {
  Json result;
  const RunOutcome outcome = ended_by_hand(
      "arrivals: [{robot: anna, x_m: 5, y_m: 0, within_m: 1, before_s: 0.2}]", result);
  EXPECT_TRUE(outcome.whole && outcome.ended_by_hand_s);
  EXPECT_TRUE(outcome.checks_fail);
  EXPECT_FALSE(outcome.good());
}

TEST(Run, AResultThatCannotBeWrittenCostsNoOtherAndIsNamed) {
  Host host;
  const auto scenario =
      host.expand(fmt::format("name: full\nduration_s: 0.1\nstep_s: 0.01\npace: max\nrobots:\n"
                              "  - {{name: anna, pose: {{x_m: 0, y_m: 0}}, robot: {{{}, {}}}}}\n",
                              kBody, kWheels));
  ASSERT_TRUE(scenario) << scenario.error().text();
  RunOptions options;
  options.output = std::filesystem::path(::testing::TempDir()) / "rave_run_full";
  std::filesystem::remove_all(options.output);
  // No file can take the place of a folder.
  for (const char* const file : {"summary.txt", "events.log", "picture.svg"}) {
    std::filesystem::create_directories(options.output / file);
  }
  const auto outcome = run(*scenario, host.catalogue(), options);
  ASSERT_TRUE(outcome) << outcome.error().text();
  EXPECT_FALSE(outcome->whole || outcome->good());
  const Json result = Json::parse(read_file(options.output / "result.json").value_or("{}"));
  EXPECT_EQ(result.at("whole"), false);
  ASSERT_EQ(outcome->problems.size(), 3U);
  EXPECT_EQ(result.at("problems"), Json(outcome->problems));
  for (const char* const file : {"summary.txt", "events.log", "picture.svg"}) {
    EXPECT_NE(result.at("problems").dump().find(std::string(file) + "` is not written: cannot "),
              std::string::npos)
        << result.at("problems");
  }
  EXPECT_NE(outcome->summary.find("is not written: "), std::string::npos) << outcome->summary;
  EXPECT_TRUE(std::filesystem::is_regular_file(options.output / "picture.png"));
  EXPECT_EQ(outcome->hash.size(), 16U);
  std::filesystem::remove_all(options.output);
}

TEST(Run, IsNotWholeWhenARecordingHasNoPoseOfItsRobot) {
  RunOutcome outcome;
  // Nothing of the first step is known yet of a robot whose first pose comes later.
  const Json result = result_of(
      "name: early\nduration_s: 0.01\npace: max\nchecks:\n  sightings: {real: camera, twin: "
      "camera_twin}\nrobots:\n  - {name: real-1, file: ../robots/recorded-create.yaml, variables: "
      "{robot: 1, barcode: 5}}\n",
      "early", outcome);
  EXPECT_FALSE(outcome.checks_hold);
  EXPECT_FALSE(result.at("checks_hold"));
  ASSERT_FALSE(outcome.problems.empty());
  EXPECT_NE(outcome.problems.back().find(
                "the sighting check fails: 0 real sightings had a code that a body carries"),
            std::string::npos)
      << outcome.problems.back();
}

}  // namespace
}  // namespace rave::runtime::testing
