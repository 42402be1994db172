// SPDX-License-Identifier: Apache-2.0
#include <future>
#include <thread>

#include "rave/assemble/parameter_key.hpp"
#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/host/run.hpp"

namespace rave::runtime::testing {
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

TEST(Changes, ParametersHaveTheValuesOfTheFilesAtFirst) {
  Host host;
  auto built = host.build_text(with(""));
  ASSERT_TRUE(built) << built.error().text();
  const std::uint32_t anna = built->spec.robots[0].type;
  const auto first = first_values(built->spec.types[anna]);
  const auto engine = sim::Engine::create(std::move(built->spec));
  ASSERT_TRUE(engine) << engine.error().text();
  const auto named = [](const auto& values, std::string_view key) -> std::string {
    for (const auto& [name, value] : values) {
      if (name == key) return value;
    }
    return "missing";
  };
  EXPECT_EQ(named(first, "body.scale"), "1");
  ASSERT_NE(named(first, "program.cruise_mps"), "missing");
  const auto change = parse_change((*engine)->spec().types[anna], "program.cruise_mps",
                                   codec::RawNode::number(0.25));
  ASSERT_TRUE(change) << change.error().text();
  const auto now = [&] {
    return (*engine)->parameter(RobotId(0), change->part, change->index, change->name);
  };
  EXPECT_EQ(now(), named(first, "program.cruise_mps"));
  EXPECT_TRUE(changed_values(**engine, RobotId(0)).empty());
  ASSERT_TRUE((*engine)->set_parameters(RobotId(0), std::span(&*change, 1)));
  EXPECT_EQ(now(), "0.25");
  using Values = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(changed_values(**engine, RobotId(0)), (Values{{"program.cruise_mps", "0.25"}}));
  EXPECT_TRUE(changed_values(**engine, RobotId(1)).empty());
  const auto scale =
      parse_change((*engine)->spec().types[anna], "body.scale", codec::RawNode::number(1.5));
  const auto back =
      parse_change((*engine)->spec().types[anna], "program.cruise_mps",
                   codec::RawNode::number(std::stod(named(first, "program.cruise_mps"))));
  ASSERT_TRUE(scale && back);
  ASSERT_TRUE((*engine)->set_parameters(RobotId(0), std::vector{*scale, *back}));
  EXPECT_EQ(changed_values(**engine, RobotId(0)), (Values{{"body.scale", "1.5"}}));
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

TEST(Changes, OfObstaclesBecomePartOfTheEngine) {
  Host host;
  const std::string changes =
      "obstacles: [{name: post, disc_radius_m: 0.1, x_m: 9}]\nchanges:\n"
      "  - {at_s: 0.5, remove_obstacle: crate}\n"
      "  - {at_s: 0.2, add_obstacle: {name: crate, box_m: [0.5, 0.3], x_m: 1, y_m: 2, yaw_deg: "
      "90}}\n"
      "  - {at_s: 0.3, robot: anna, set: {body.scale: 1.2}}\n"
      "  - {at_s: 0.3, move_obstacle: {name: post, x_m: 7}}\n";
  const auto built = host.build_text(with(changes));
  ASSERT_TRUE(built) << built.error().text();
  EXPECT_EQ(built->spec.changes.size(), 1U);
  const auto& all = built->spec.obstacle_changes;
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].step, 20U);
  EXPECT_EQ(all[0].change.kind, sim::ObstacleChange::Kind::kAdd);
  EXPECT_EQ(all[0].change.name, "crate");
  EXPECT_NEAR(all[0].change.X_WB.yaw, 1.5707963, 1e-6);
  EXPECT_EQ(all[0].change.body.shapes.size(), 1U);
  EXPECT_EQ(all[1].step, 30U);
  EXPECT_EQ(all[1].change.X_WB, (Pose2{7, 0, 0}));
  EXPECT_EQ(all[2].step, 50U);
  EXPECT_EQ(all[2].change.kind, sim::ObstacleChange::Kind::kRemove);
  const auto scenario = host.expand(with(changes));
  ASSERT_TRUE(scenario);
  const auto again = host.expand(config::write_expanded(*scenario));
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(again->scenario.changes, scenario->scenario.changes);
}

TEST(Changes, OfObstaclesThatCannotBeAreErrorsOfTheFile) {
  Host host;
  const auto error = [&](const std::string& change) {
    return host.error_of(with(
        "obstacles: [{name: post, disc_radius_m: 0.1, x_m: 9}]\nchanges:\n  - {" + change + "}\n"));
  };
  EXPECT_EQ(error("at_s: 0, remove_obstacle: pst"),
            "s.yaml:5:32: there is no obstacle `pst`; did you mean `post`?");
  EXPECT_NE(error("at_s: 0").find("change per entry, found 0: `robot`"), std::string::npos);
  EXPECT_NE(error("at_s: 0, robot: anna, set: {body.scale: 2}, remove_obstacle: post")
                .find("change per entry, found 2: `robot`"),
            std::string::npos);
  EXPECT_NE(error("at_s: 0, set: {body.scale: 2}").find("`set` needs `robot`"), std::string::npos);
  EXPECT_NE(error("at_s: 0, robot: anna").find("found nothing, expected keys"), std::string::npos);
  EXPECT_NE(error("at_s: 0, add_obstacle: {name: crate}").find("disc_radius_m"), std::string::npos);
  EXPECT_NE(error("at_s: 0, move_obstacle: {name: post, x_m: .nan}").find("`x_m`"),
            std::string::npos);
  EXPECT_NE(error("at_s: 0.005, remove_obstacle: post").find("a multiple of the scenario's step"),
            std::string::npos);
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
  const auto ask = [&](request::Action action, const std::string& robot) {
    return control.ask({std::move(action), robot}, std::chrono::minutes(1));
  };
  EXPECT_EQ(ask(request::Stop(), "").value(), "stopped anna");
  EXPECT_TRUE(control.status().robots.at(0).stopped);
  EXPECT_EQ(ask(request::Arm(), "anna").error().code, ErrorCode::kState);
  EXPECT_EQ(ask(request::Stop(), "ann").error().message,
            "there is no robot `ann`; did you mean `anna`?");
  EXPECT_EQ(ask(request::Set{"program.cruise_mps", "0.1"}, "anna").value(),
            "anna: program.cruise_mps: 0.2 -> 0.1");
  EXPECT_EQ(ask(request::Set{"program.cruise_mps", "["}, "anna").error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(ask(request::Set{"program.cruise_mps", "99"}, "anna").error().code, ErrorCode::kParse);
  EXPECT_EQ(ask(request::Set{"body.scale", "1"}, "").error().code, ErrorCode::kInvalidArgument);
  const auto edit = [&](const std::string& text) {
    // One that says nothing is what read_edit() refuses; code may put it together.
    return ask(request::Edit{text.empty() ? config::ObstacleEdit()
                                          : config::read_edit(text, "test").value()},
               "");
  };
  EXPECT_EQ(edit("{add_obstacle: {name: crate, box_m: [1, 2], x_m: 5, y_m: 0.5}}").value(),
            "added `crate` at (5, 0.5), yaw 0 rad (by hand); counts from step 0 on, at 0.000 s");
  EXPECT_EQ(edit("{move_obstacle: {name: crate, x_m: 6}}").value(),
            "moved `crate` at (6, 0), yaw 0 rad (by hand); counts from step 0 on, at 0.000 s");
  EXPECT_EQ(edit("").error().code, ErrorCode::kParse);
  EXPECT_EQ(edit("{move_obstacle: {name: crte, x_m: 6}}").error().message,
            "there is no obstacle `crte`; did you mean `crate`?");
  EXPECT_EQ(edit("{add_obstacle: {name: lid, disc_radius_m: 1}}").error().code,
            ErrorCode::kInvalidArgument);
  const std::string listed = ask(request::ListObstacles(), "").value();
  EXPECT_TRUE(listed.starts_with("1 obstacle\n     1  crate ")) << listed;
  control.resume();
  const auto ended = outcome.get();
  ASSERT_TRUE(ended) << ended.error().text();
  EXPECT_NE(ended->summary.find("changed by people"), std::string::npos) << ended->summary;
  EXPECT_EQ(ask(request::Stop(), "").error().code, ErrorCode::kState);
  std::filesystem::remove_all(options.output);
}

}  // namespace
}  // namespace rave::runtime::testing
