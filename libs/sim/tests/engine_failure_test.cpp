// SPDX-License-Identifier: Apache-2.0
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// Six ways to fail, each after 0.1 s, among robots that do not; all drive ahead with 1 m/s in
/// lanes of their own.
EngineSpec failing_world(unsigned threads) {
  EngineSpec spec;
  spec.threads = threads;
  const auto lane = [&spec] { return Pose2{0, 0.5 * static_cast<double>(spec.robots.size()), 0}; };
  const auto add = [&](RobotType type, Numbers drive) {
    type.program = program<Drive>(drive);
    add_robot(spec, std::move(type), lane());
  };
  add(simulated_type(), {{"v", 1}, {"throw_at", 10}});
  add(simulated_type(), {{"v", 1}, {"nan_at", 10}});
  add(simulated_type({{"throw_after", 10}}), {{"v", 1}});
  add(simulated_type({{"nan_after", 10}}), {{"v", 1}});
  add(simulated_type({}, {{"throw_after", 10}}), {{"v", 1}});
  RobotType blind = simulated_type();
  blind.sensors.push_back(virtual_sensor<Counter>("counter", {{"throw_at", 11}}));
  add(std::move(blind), {{"v", 1}});
  add(simulated_type(), {{"v", 1}});
  while (spec.robots.size() < 150) add_twin(spec, lane());
  return spec;
}

TEST(EngineFailure, CostsOnlyTheRobotItHappensTo) {
  const auto engine = make_engine(failing_world(1));
  const auto events = run(*engine, 50);
  const std::pair<EventKind, const char*> expected[] = {
      {EventKind::kProgramFailed, "program `program`: threw an exception: out of ideas"},
      {EventKind::kDriverFailed, "controller `drive`: gave a command that is not finite"},
      {EventKind::kDriverFailed, "actuator `wheels`: threw an exception: a wheel came off"},
      {EventKind::kDriverFailed, "actuator `wheels`: proposed a velocity that is not finite"},
      {EventKind::kDriverFailed, "controller `drive`: threw an exception: burnt out"},
      {EventKind::kDriverFailed,
       "sensor `counter` (driver `counter`): threw an exception: lens cap on"},
  };
  ASSERT_EQ(events.size(), std::size(expected));
  for (std::uint32_t r = 0; r < std::size(expected); ++r) {
    EXPECT_EQ(events[r].step, 10U);
    EXPECT_EQ(events[r].robot, RobotId(r));
    EXPECT_EQ(events[r].kind, expected[r].first);
    EXPECT_EQ(events[r].text, expected[r].second);
  }
  // The one without a program drives on until its watchdog; those without wheels stand at once.
  EXPECT_NEAR(engine->true_pose(RobotId(0)).x, 0.2, 1e-12);
  EXPECT_FALSE(engine->program_alive(RobotId(0)));
  for (const std::uint32_t r : {1U, 2U, 3U, 4U}) {
    EXPECT_NEAR(engine->true_pose(RobotId(r)).x, 0.1, 1e-12) << r;
  }
  // A lost sensor does not stop a robot; its last sample is gone.
  EXPECT_EQ(engine->sensor(RobotId(5), 0).header->count, 0U);
  for (std::uint32_t r = 5; r < 150; ++r) {
    ASSERT_NEAR(engine->true_pose(RobotId(r)).x, 0.5, 1e-9) << r;
  }
}

TEST(EngineFailure, LeavesTheHashTheSameForAnyNumberOfThreads) {
  const auto one = make_engine(failing_world(1));
  run(*one, 50);
  for (const unsigned threads : {2U, 4U}) {
    const auto many = make_engine(failing_world(threads));
    run(*many, 50);
    EXPECT_EQ(many->hash(), one->hash());
    ASSERT_TRUE(many->reset().has_value());
    EXPECT_TRUE(many->program_alive(RobotId(0)));
    run(*many, 50);
    EXPECT_EQ(many->hash(), one->hash());
  }
}

/// Fails at the decision that it is told.
class Fragile final : public ProgramProcess {
 public:
  explicit Fragile(std::uint32_t fail_at) : fail_at_(fail_at) {}
  Status begin(const DecideItem& item) override {
    if (item.decision == fail_at_ && fail_at_ % 2 == 0) return fail(ErrorCode::kIo, "pipe broken");
    EXPECT_LE(item.decision, fail_at_) << "asked again after an error";
    return {};
  }
  Status end(const DecideItem& item) override {
    if (item.decision == fail_at_) return fail(ErrorCode::kTimeout, "killed after 1 s");
    item.commands[0] = velocity_command(1, 0);
    return {};
  }

 private:
  std::uint32_t fail_at_;
};

TEST(EngineFailure, OfAnIsolatedProgramStopsItsRobot) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Drive>();
  type.program->isolate = [](const ProgramSetup& setup) -> Result<std::unique_ptr<ProgramProcess>> {
    return std::make_unique<Fragile>(10 + setup.robot.id);
  };
  type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.01}, {"room", 4}}));
  add_robot(spec, std::move(type));
  add_twin(spec, {0, 1, 0});
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 60);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].text, "program `program`: pipe broken");
  EXPECT_EQ(events[0].step, 10U);
  EXPECT_EQ(events[1].text, "program `program`: killed after 1 s");
  EXPECT_EQ(events[1].step, 11U);
  EXPECT_NEAR(engine->true_pose(RobotId(0)).x, 0.2, 1e-12);
  EXPECT_NEAR(engine->true_pose(RobotId(1)).x, 0.21, 1e-12);
  // Events do not pile up for a program that is gone.
  EXPECT_EQ(engine->sensor(RobotId(0), 0).header->count, 1U);
  EXPECT_EQ(engine->sensor(RobotId(0), 0).header->dropped, 0U);
}

TEST(EngineFailure, OfAProgramToStartNamesRobotAndDriver) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Roam>();
  add_robot(spec, std::move(type));
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine.has_value());
  EXPECT_EQ(engine.error().text().substr(0, 52),
            "robot `r0`, program `program` (driver `program`): ro")
      << engine.error().text();
}

}  // namespace
}  // namespace rave::sim::testing
