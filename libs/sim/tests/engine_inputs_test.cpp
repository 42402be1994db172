// SPDX-License-Identifier: Apache-2.0
#include "rave/sim_testing/engine_fixture.hpp"
#include "rave/sim_testing/given.hpp"

namespace rave::sim::testing {
namespace {

constexpr ParamSpec kCruiserParams[] = {
    number_param("v", "m/s", 0.2, 0, 1, "Speed."),
    number_param("w", "rad/s", 0, -1, 1, "Turning rate."),
    integer_param("gear", 1, 1, 5, "Only odd ones are built."),
};

/// Drives with a speed that can be changed; refuses even gears and, with w set, speeds above 0.5.
class Cruiser final : public DecisionProcess {
 public:
  Status start(const Setup& setup) override {
    setup_ = setup;
    RAVE_TRY_ASSIGN(drive_, setup.controller(CommandKind::kVelocity));
    return parameters_changed(setup.params());
  }
  Status parameters_changed(const Params& params) override {
    if (static_cast<std::int64_t>(given(params, "gear")) % 2 == 0)
      return fail(ErrorCode::kInvalidArgument, "no such gear");
    if (given(params, "w") != 0 && given(params, "v") > 0.5) {
      return fail(ErrorCode::kInvalidArgument, "too fast for a curve");
    }
    v_mps_ = given(params, "v");
    w_radps_ = given(params, "w");
    radius_m_ = setup_->robot_radius_m();
    return {};
  }
  void decide(const Percepts&, Commands& commands) override {
    // A large body makes it careful.
    commands.velocity(drive_, radius_m_ > 0.2 ? 0.5 * v_mps_ : v_mps_, w_radps_);
  }

 private:
  std::optional<Setup> setup_;
  ControllerHandle drive_;
  double v_mps_ = 0;
  double w_radps_ = 0;
  double radius_m_ = 0;
};

RobotType cruiser_type() {
  RobotType type = simulated_type();
  type.program = program<Cruiser>({{"v", 0.2}, {"w", 0}, {"gear", 1}});
  type.program->param_specs = kCruiserParams;
  return type;
}

ParameterChange to(const char* name, ParameterValue value) {
  return {ParameterChange::Part::kProgram, 0, name, std::move(value)};
}
ParameterChange scale(double value) { return {ParameterChange::Part::kBody, 0, "scale", value}; }
Status set(Engine& engine, RobotId robot, std::vector<ParameterChange> changes) {
  return engine.set_parameters(robot, changes);
}

TEST(EngineInputs, AChangeCountsFromTheNextStep) {
  EngineSpec spec;
  const RobotId one = add_robot(spec, cruiser_type());
  const RobotId two = add_twin(spec, {0, 2, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  ASSERT_TRUE(set(*engine, one, {to("v", 0.6)}));
  EXPECT_EQ(engine->parameter(one, ParameterChange::Part::kProgram, 0, "v"), "0.6");
  EXPECT_EQ(engine->parameter(two, ParameterChange::Part::kProgram, 0, "v"), "0.2");
  const auto events = run(*engine, 10);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kChanged);
  EXPECT_EQ(events[0].step, 10U);
  EXPECT_EQ(events[0].text, "program.v: 0.2 -> 0.6 (by hand)");
  EXPECT_NEAR(engine->true_pose(one).x, 0.02 + 0.06, 1e-12);
  EXPECT_NEAR(engine->true_pose(two).x, 0.04, 1e-12);
  EXPECT_EQ(engine->inputs_by_hand(), 1U);
  ASSERT_TRUE(engine->reset());
  EXPECT_EQ(engine->parameter(one, ParameterChange::Part::kProgram, 0, "v"), "0.2");
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(one).x, 0.02, 1e-12);
}

TEST(EngineInputs, ARefusedChangeLeavesEverythingAsItWas) {
  const auto untouched = [](auto&& spoil) {
    EngineSpec spec;
    spec.world.obstacles.push_back(box({0, 0.4, 0}, 4, 0.1, 1, "wall"));
    const RobotId robot = add_robot(spec, cruiser_type());
    const auto engine = make_engine(std::move(spec));
    run(*engine, 10);
    spoil(*engine, robot);
    EXPECT_EQ(engine->inputs_by_hand(), 0U);
    run(*engine, 50);
    return engine->hash();
  };
  const RunHash plain = untouched([](Engine&, RobotId) {});
  const auto refused = [&](const std::string& why, std::vector<ParameterChange> changes) {
    EXPECT_EQ(untouched([&](Engine& engine, RobotId robot) {
                const Status status = set(engine, robot, changes);
                ASSERT_FALSE(status) << why;
                EXPECT_NE(status.error().text().find(why), std::string::npos)
                    << status.error().text();
              }),
              plain)
        << why;
  };
  refused("did you mean `gear`", {to("gaer", 1.0)});
  refused("expected 0 to 1 m/s", {to("v", 1.5)});
  refused("expected 0 to 1 m/s", {to("v", std::numeric_limits<double>::quiet_NaN())});
  refused("a whole number", {to("gear", 1.5)});
  refused("a number", {to("v", std::string("fast"))});
  refused("no such gear", {to("gear", 2.0)});
  refused("too fast for a curve", {to("v", 0.6), to("w", 0.1)});
  refused("no controller with this number", {{ParameterChange::Part::kController, 7, "x", 1.0}});
  refused("there is no parameter `x`", {{ParameterChange::Part::kController, 0, "x", 1.0}});
  refused("nothing to change", {});
  // The body would overlap the wall; what the program has taken by then is taken back.
  refused("it would overlap `wall`", {to("v", 0.6), scale(3)});
  refused("expected 0.05 to 20", {scale(0)});
}

TEST(EngineInputs, ChangesOfOnePartComeTogether) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, cruiser_type());
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(set(*engine, robot, {to("v", 0.6)}));
  EXPECT_FALSE(set(*engine, robot, {to("w", 0.1)}));
  EXPECT_TRUE(set(*engine, robot, {to("w", 0.1), to("v", 0.4)}));
}

TEST(EngineInputs, ABodyGrowsForTouchAndSight) {
  EngineSpec spec;
  const RobotId grower = add_robot(spec, cruiser_type(), {0, 0, 0});
  RobotType watcher_type = simulated_type();
  watcher_type.sensors.push_back(laser());
  const RobotId watcher = add_robot(spec, std::move(watcher_type), {-2, 0, 0});
  spec.world.obstacles.push_back(box({1.05, 0, 0}, 0.1, 2, 1, "wall"));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 1);
  EXPECT_NEAR(range(*engine, watcher, 0), 1.85, 1e-6);
  ASSERT_TRUE(set(*engine, grower, {scale(2)}));
  EXPECT_DOUBLE_EQ(engine->body_radius_m(grower), 0.3);
  run(*engine, 1);
  EXPECT_NEAR(range(*engine, watcher, 0), 1.7 + 0.002, 1e-6);
  run(*engine, 1500);
  // Its program knows that it has grown, and the wall meets the larger outline.
  EXPECT_NEAR(engine->true_pose(grower).x, 0.7, 1e-3);
  const Status status = set(*engine, grower, {scale(2.1)});
  ASSERT_FALSE(status);
  EXPECT_TRUE(set(*engine, grower, {scale(1)}));
  run(*engine, 100);
  EXPECT_GT(engine->true_pose(grower).x, 0.8);
  ASSERT_TRUE(engine->reset());
  EXPECT_DOUBLE_EQ(engine->body_radius_m(grower), 0.15);
}

TEST(EngineInputs, ChangesOfTheScenarioBelongToTheRun) {
  const auto hash = [](unsigned threads, double v, std::uint64_t at) {
    EngineSpec spec;
    spec.threads = threads;
    add_robot(spec, cruiser_type());
    for (std::uint32_t i = 1; i < 150; ++i) {
      const std::uint32_t row = i / 12;
      add_twin(spec, {0.5 * (i % 12), 0.5 * row, 0});
    }
    spec.changes.push_back({at, RobotId(5), {to("v", v)}});
    spec.changes.push_back({at, RobotId(7), {scale(0.7), to("w", 0.3)}});
    const auto engine = make_engine(std::move(spec));
    const auto events = run(*engine, 100);
    EXPECT_EQ(of_kind(events, EventKind::kChanged).size(), 2U);
    EXPECT_EQ(engine->inputs_by_hand(), 0U);
    const RunHash first = engine->hash();
    EXPECT_TRUE(engine->reset());
    run(*engine, 100);
    EXPECT_EQ(engine->hash(), first);
    return first;
  };
  const RunHash one = hash(1, 0.4, 20);
  EXPECT_EQ(hash(1, 0.4, 20), one);
  EXPECT_EQ(hash(2, 0.4, 20), one);
  EXPECT_EQ(hash(3, 0.4, 20), one);
  EXPECT_NE(hash(1, 0.41, 20), one);
  EXPECT_NE(hash(1, 0.4, 21), one);
}

TEST(EngineInputs, ARefusedChangeOfTheScenarioIsTold) {
  EngineSpec spec;
  add_robot(spec, cruiser_type());
  spec.changes.push_back({5, RobotId(0), {to("gear", 2.0)}});
  const auto engine = make_engine(std::move(spec));
  const auto events = of_kind(run(*engine, 10), EventKind::kChangeRefused);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step, 5U);
  EXPECT_NE(events[0].text.find("no such gear"), std::string::npos);
}

}  // namespace
}  // namespace rave::sim::testing
