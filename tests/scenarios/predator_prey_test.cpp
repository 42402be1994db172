// SPDX-License-Identifier: Apache-2.0
// The hunt: what its page promises.
#include <nlohmann/json.hpp>

#include "rave/base/file.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

class PredatorPrey : public ScenarioTest {
 protected:
  Json result() const { return Json::parse(read_file(folder_ / "result.json").value_or("{}")); }
};

TEST_F(PredatorPrey, ThePreyIsCaughtOnceItHasChanged) {
  const auto outcome = run(load("predator-prey"));
  EXPECT_TRUE(outcome.whole && outcome.checks_hold);
  const Json json = result();
  const Json& capture = json.at("capture");
  ASSERT_EQ(capture.at("captures").size(), 1U) << capture;
  EXPECT_EQ(capture["captures"][0]["predator"], "predator");
  EXPECT_EQ(capture["captures"][0]["prey"], "prey");
  EXPECT_GT(capture.at("captured_at_s"), 60.0);
  EXPECT_LT(capture.at("captured_at_s"), 120.0);
  ASSERT_EQ(json.at("changes").size(), 3U);
  for (const Json& change : json.at("changes")) EXPECT_TRUE(change.at("made")) << change;
  EXPECT_EQ(json["changes"][0]["what"], "body.scale: 1 -> 1.5");
  EXPECT_EQ(json.at("inputs_by_hand"), 0);
  EXPECT_EQ(json["events"]["captured"], 1);
  EXPECT_EQ(json["events"]["changed"], 3);
  EXPECT_EQ(json["events"]["contact"], 0);
  const std::string events = read_file(folder_ / "events.log").value_or("");
  EXPECT_NE(events.find("captured"), std::string::npos);
}

TEST_F(PredatorPrey, TheSameEachTimeAndForAnyNumberOfThreads) {
  auto scenario = load("predator-prey");
  const std::string one = run(scenario).hash;
  EXPECT_FALSE(one.empty());
  for (const int threads : {1, 2, 3}) {
    scenario.scenario.threads = threads;
    EXPECT_EQ(run(scenario).hash, one) << threads;
  }
  scenario.scenario.changes[0].at_s->value += 0.01;
  EXPECT_NE(run(scenario).hash, one);
}

TEST_F(PredatorPrey, AnIsolatedPreyTakesTheSameChanges) {
  auto scenario = load("predator-prey");
  const std::string inside = run(scenario).hash;
  for (config::RobotGroup& group : scenario.groups) group.robot.program->isolate = true;
  EXPECT_EQ(run(scenario).hash, inside);
}

TEST_F(PredatorPrey, AStopByTheGuardIsSeenInSummaryAndResult) {
  auto scenario = load("predator-prey");
  scenario.scenario.duration_s = 20;
  scenario.scenario.changes.clear();
  scenario.scenario.picture.reset();
  scenario.scenario.checks.capture->before_s.reset();
  config::GuardFile& guard = *scenario.groups[0].robot.guard;
  guard.max_speed_mps = 0.1;
  guard.fence_m->value = {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}};
  const auto outcome = run(scenario);
  EXPECT_TRUE(outcome.whole);
  EXPECT_NE(outcome.summary.find("x by fence"), std::string::npos) << outcome.summary;
  EXPECT_NE(outcome.summary.find("x by speed"), std::string::npos) << outcome.summary;
  const Json json = result();
  EXPECT_GE(json["guard"]["predator"]["slowed by fence"], 1);
  const Json& pose = json["robots"][0]["final_pose"];
  EXPECT_LE(pose.at("x_m"), 1.5 - 0.165 + 1e-3);
  EXPECT_LE(pose.at("y_m"), 1.5 - 0.165 + 1e-3);
}

}  // namespace
}  // namespace rave::tests
