// SPDX-License-Identifier: Apache-2.0
#include <future>
#include <thread>

#include "host_fixture.hpp"
#include "rave/robot_host/parameter_key.hpp"
#include "rave/robot_host/run.hpp"

namespace rave::robot_host::testing {
namespace {

std::string with(const std::string& changes, const std::string& guard = {}) {
  return scenario_text(
      "  - {name: anna, file: ../robots/wanderer.yaml, pose: {x_m: 0, y_m: 0}}\n"
      "  - {name: herd, robot: {" +
          kBody + ", " + kWheels + guard + "}, poses: [[3, 0, 0], [6, 0, 0]]}\n",
      changes);
}

TEST(Changes, BecomePartOfTheEngine) {
  Host host;
  const auto built = host.build_text(
      with("changes:\n"
           "  - {at_s: 0.5, robot: herd, set: {controller.drive.watchdog_s: 2, body.scale: 1.2}}\n"
           "  - {at_s: 0.2, robot: anna, set: {program.cruise_mps: 0.3}}\n"));
  ASSERT_TRUE(built) << built.error().text();
  const auto& changes = built->spec.changes;
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].step, 20U);
  EXPECT_EQ(changes[0].robot.value(), 0U);
  EXPECT_EQ(changes[1].step, 50U);
  EXPECT_EQ(changes[2].robot.value(), 2U);
  EXPECT_EQ(changes[2].changes.size(), 2U);
}

TEST(Changes, ErrorsPointAtTheFileAndNameTheNearest) {
  Host host;
  EXPECT_EQ(host.error_of(with("changes:\n  - {at_s: 0, robot: ana, set: {body.scale: 2}}\n")),
            "s.yaml:4:22: `robot`: there is no robot `ana`; did you mean `anna`?");
  EXPECT_EQ(
      host.error_of(with("changes:\n  - {at_s: 0.005, robot: anna, set: {body.scale: 2}}\n")),
      "s.yaml:4:12: `at_s`: found 0.005, expected a multiple of the scenario's step (0.01 s)");
  EXPECT_EQ(
      host.error_of(with("changes:\n  - {at_s: 0, robot: anna, set: {program.cruse_mps: 2}}\n")),
      "s.yaml:4:53: there is no parameter `program.cruse_mps`; did you mean "
      "`program.cruise_mps`?");
  const std::string range =
      host.error_of(with("changes:\n  - {at_s: 0, robot: anna, set: {program.cruise_mps: 200}}\n"));
  EXPECT_TRUE(range.starts_with("s.yaml:4:54: ")) << range;
  const std::string none = host.error_of(with("changes:\n  - {at_s: 0, robot: anna, set: {}}\n"));
  EXPECT_NE(none.find("s.yaml:4:"), std::string::npos) << none;
  const std::string unknown =
      host.error_of(with("changes:\n  - {at_s: 0, robt: anna, set: {body.scale: 2}}\n"));
  EXPECT_NE(unknown.find("did you mean `robot`"), std::string::npos) << unknown;
}

TEST(Changes, SurviveTheExpandedScenario) {
  Host host;
  const auto scenario =
      host.expand(with("changes:\n  - {at_s: 0.5, robot: herd, set: {body.scale: 1.2}}\n"));
  ASSERT_TRUE(scenario) << scenario.error().text();
  const auto again = host.expand(config::write_expanded(*scenario));
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(again->scenario.changes, scenario->scenario.changes);
}

TEST(Guards, AreReadAndChecked) {
  Host host;
  const auto built = host.build_text(
      with("", ", guard: {max_turn_dps: 180, fence_m: [[0, 0], [9, 0], [9, 9]], separation_m: 0}"));
  ASSERT_TRUE(built) << built.error().text();
  EXPECT_FALSE(built->spec.types[0].guard);
  ASSERT_TRUE(built->spec.types[1].guard);
  EXPECT_NEAR(built->spec.types[1].guard->max_turn_radps, 3.14159265, 1e-8);
  EXPECT_EQ(built->spec.types[1].guard->separation_m, 0);
  EXPECT_EQ(built->spec.types[1].guard->fence_W.size(), 3U);
  const std::string crossing =
      host.error_of(with("", ", guard: {fence_m: [[0, 0], [1, 1], [1, 0], [0, 1]]}"));
  EXPECT_NE(crossing.find("`fence_m` of `herd`"), std::string::npos) << crossing;
}

TEST(Requests, AreServedBetweenStepsAlsoWhilePaused) {
  Host host;
  const auto scenario = host.expand(
      "name: held\nduration_s: 30\npace: max\nrobots:\n"
      "  - {name: anna, file: ../robots/wanderer.yaml, pose: {x_m: 0, y_m: 0}}\n");
  ASSERT_TRUE(scenario) << scenario.error().text();
  RunControl control;
  control.pause();
  RunOptions options;
  options.output = std::filesystem::path(::testing::TempDir()) / "rave_requests";
  options.picture = false;
  options.control = &control;
  auto outcome =
      std::async(std::launch::async, [&] { return run(*scenario, host.catalogue(), options); });
  while (control.status().scenario.empty()) std::this_thread::yield();
  const auto ask = [&](RunRequest::Kind kind, const std::string& robot, const std::string& key = {},
                       const std::string& value = {}) {
    return control.ask({kind, robot, key, value}, std::chrono::minutes(1));
  };
  EXPECT_EQ(ask(RunRequest::Kind::kStop, "").value(), "stopped anna");
  EXPECT_TRUE(control.status().robots.at(0).stopped);
  EXPECT_EQ(ask(RunRequest::Kind::kArm, "anna").error().code, ErrorCode::kState);
  EXPECT_EQ(ask(RunRequest::Kind::kStop, "ann").error().message,
            "there is no robot `ann`; did you mean `anna`?");
  EXPECT_EQ(ask(RunRequest::Kind::kSet, "anna", "program.cruise_mps", "0.1").value(),
            "anna: program.cruise_mps: 0.2 -> 0.1");
  EXPECT_EQ(ask(RunRequest::Kind::kSet, "anna", "program.cruise_mps", "[").error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(ask(RunRequest::Kind::kSet, "anna", "program.cruise_mps", "99").error().code,
            ErrorCode::kParse);
  EXPECT_EQ(ask(RunRequest::Kind::kSet, "", "body.scale", "1").error().code,
            ErrorCode::kInvalidArgument);
  control.resume();
  const auto ended = outcome.get();
  ASSERT_TRUE(ended) << ended.error().text();
  EXPECT_NE(ended->summary.find("changed by hand"), std::string::npos) << ended->summary;
  EXPECT_EQ(ask(RunRequest::Kind::kStop, "").error().code, ErrorCode::kState);
  std::filesystem::remove_all(options.output);
}

}  // namespace
}  // namespace rave::robot_host::testing
