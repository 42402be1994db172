// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <cmath>

#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineHardware, ADriverThatNeverAnswersEndsTheRun) {
  EngineSpec spec;
  spec.host_timeout = std::chrono::milliseconds(20);
  add_robot(spec, real_type({{"silent", 1}}));
  const auto engine = make_engine(std::move(spec));
  const Status status = engine->step();
  ASSERT_FALSE(status.has_value());
  EXPECT_EQ(status.error().code, ErrorCode::kTimeout);
  EXPECT_EQ(status.error().text(),
            "robot `r0`, sensor `mocap` (driver `mocap`) has not declared its samples complete up "
            "to 0.000 s for 20 ms; the run cannot continue");
}

TEST(EngineHardware, ALostDeviceIsToldInTheStepThatMissesItAndTheRunGoesOn) {
  RunHash first;
  for (int again = 0; again < 20; ++again) {
    EngineSpec spec;
    const RobotId real = add_robot(spec, real_type({{"vx", 1}, {"fail_s", 0.1}}));
    const auto engine = make_engine(std::move(spec));
    const auto events = run(*engine, 100);
    // The driver's thread knows long before; its last pose is that of 0.098 s.
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].kind, EventKind::kDriverFailed);
    EXPECT_EQ(events[0].step, 10U);
    EXPECT_EQ(events[0].text, "sensor `mocap`: cable pulled");
    EXPECT_EQ(events[1].kind, EventKind::kPoseStale);
    EXPECT_EQ(events[1].step, 60U);
    EXPECT_EQ(events[1].text, "its last pose is from 0.10 s");
    EXPECT_TRUE(engine->reported(real).stale);
    EXPECT_NEAR(engine->snapshot().pose(real).x, 0.098, 1e-12);
    if (again == 0) first = engine->hash();
    EXPECT_EQ(engine->hash(), first);
  }
}

TEST(EngineHardware, ARealRobotIsInTheWorldFromItsFirstPoseOn) {
  EngineSpec spec;
  const RobotId real = add_robot(spec, real_type({{"x", 1}, {"first_s", 0.2}}));
  RobotType type = simulated_type();
  type.sensors.push_back(laser());
  const RobotId watcher = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 20);
  EXPECT_FALSE(engine->snapshot().robot(real).present);
  EXPECT_FALSE(engine->reported(real).known);
  EXPECT_TRUE(std::isinf(range(*engine, watcher, 0)));
  run(*engine, 1);
  EXPECT_TRUE(engine->snapshot().robot(real).present);
  EXPECT_NEAR(range(*engine, watcher, 0), 0.85, 1e-6);
}

TEST(EngineHardware, AStalePoseIsToldAndSoIsItsReturn) {
  EngineSpec spec;
  const RobotId real =
      add_robot(spec, real_type({{"vx", 0.1}, {"gap_s", 0.3}, {"gap_end_s", 1.2}}));
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 200);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::kPoseStale);
  EXPECT_EQ(events[0].text, "its last pose is from 0.29 s");
  EXPECT_EQ(events[0].step, 80U);  // the first more than 0.5 s after 0.294 s
  EXPECT_EQ(events[1].kind, EventKind::kPoseBack);
  EXPECT_EQ(events[1].text, "poses arrive again from 1.20 s");
  EXPECT_EQ(events[1].step, 121U);
  EXPECT_FALSE(engine->reported(real).stale);
  EXPECT_NEAR(engine->reported(real).velocity.vx, 0.1, 1e-9);
}

TEST(EngineHardware, SamplesThatHadToBeDroppedAreToldAtTheEnd) {
  Ears ears;
  EngineSpec spec;
  spec.log = &ears;
  add_robot(spec, real_type({{"steps_back", 1}}));
  auto engine = make_engine(std::move(spec));
  EXPECT_TRUE(of_kind(run(*engine, 20), EventKind::kDriverFailed).empty());
  EXPECT_EQ(ears.heard, "");
  engine.reset();
  EXPECT_EQ(ears.heard,
            "robot r0: sensor `mocap` (driver `mocap`) broke its contract; samples dropped: 1; "
            "first: the sample of 0.000000000 s was dropped: it came after one of 0.021000000 s; "
            "stamps must not step back\n");
}

TEST(EngineHardware, CommandsToADeafRobotAreCounted) {
  EngineSpec spec;
  RobotType type = real_type({});
  type.program = program<Drive>({{"v", 1}}, 10);
  const RobotId real = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 100);
  EXPECT_EQ(engine->commands_given(real), 10U);
  EXPECT_FALSE(engine->obeys(real));
  EXPECT_EQ(engine->command(real, 0), velocity_command(1, 0));
  EXPECT_EQ(engine->snapshot().pose(real), (Pose2{}));
}

TEST(EngineHardware, ANumberThatIsNoneNeverReachesAnActuator) {
  EngineSpec spec;
  RobotType type = real_type({});
  type.program = program<Drive>({{"v", 1}, {"nan_at", 3}});
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 20);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "controller `drive`: gave a command that is not finite");
}

/// The numbers that a ticker delivered, step by step, as observers see them.
std::vector<double> ticks(double latency_s, std::uint32_t decide_every, int steps) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.004}, {"room", 16}}));
  type.sensors[0].processing.latency_s = latency_s;
  type.program = program<Drive>({}, decide_every);
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  std::vector<double> all;
  std::uint32_t last = 0;
  for (int k = 0; k < steps; ++k) {
    run(*engine, 1);
    const SensorSample sample = engine->sensor(robot, 0);
    if (sample.header->sequence == last) continue;
    last = sample.header->sequence;
    const auto* values = static_cast<const double*>(sample.records);
    EXPECT_EQ(sample.header->dropped, 0U);
    for (std::uint32_t i = 0; i < sample.header->count; ++i) {
      if (all.empty() || values[i] > all.back()) all.push_back(values[i]);
    }
  }
  return all;
}

TEST(EngineHardware, EveryEventIsDeliveredOnceHoweverStepsAndLatencyFall) {
  // 0.012 s is no multiple of the step, so events of two steps can come due in one.
  for (const double latency_s : {0.0, 0.012, 0.9}) {
    const std::vector<double> all = ticks(latency_s, 1, 150);
    ASSERT_GT(all.size(), 100U) << latency_s;
    for (std::size_t i = 0; i < all.size(); ++i) {
      ASSERT_EQ(all[i], static_cast<double>(i + 1)) << latency_s;
    }
  }
}

TEST(EngineHardware, EventsGatherUntilTheProgramDecidesAndOverflowIsCounted) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.01}, {"room", 4}}));
  type.program = program<Diary>({}, 6);
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 12);
  // Ticks at 10 to 60 ms had come by the second decision in step 6: room for four.
  ASSERT_EQ(Diary::entries().size(), 2U);
  EXPECT_EQ(Diary::entries()[0].count, 0U);
  EXPECT_EQ(Diary::entries()[1].count, 4U);
  EXPECT_EQ(Diary::entries()[1].first, 1);
  EXPECT_EQ(Diary::entries()[1].fresh, 1U);
  run(*engine, 1);
  EXPECT_EQ(engine->sensor(robot, 0).header->dropped, 2U);
}

/// Stands still at a time that the test sets.
class StillClock final : public RunClock {
 public:
  explicit StillClock(double now_s) : now_(from_seconds(now_s).ns) {}
  [[nodiscard]] SimTime now() const noexcept override { return {now_}; }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime t) const noexcept override {
    using Time = std::chrono::steady_clock::time_point;
    return t.ns <= now_ ? Time{} : Time::max();
  }

 private:
  std::int64_t now_;
};

TEST(EngineLive, NeverWaitsForADriverAndTakesWhatHasCome) {
  const StillClock clock(0.05);
  EngineSpec spec;
  spec.live_clock = &clock;
  const RobotId real = add_robot(spec, real_type({{"live", 1}, {"vx", 1}}));
  const auto engine = make_engine(std::move(spec));
  for (int again = 0; again < 2; ++again) {
    // The clock lets the driver come to 0.049 s and no farther; steps go on without it.
    while (engine->reported(real).stamp.ns < 49'000'000) ASSERT_TRUE(engine->step().has_value());
    run(*engine, 10);
    EXPECT_NEAR(engine->snapshot().pose(real).x, 0.049, 1e-12);
    // A reset ends a driver that waits for the clock, and so does the end.
    ASSERT_TRUE(engine->reset().has_value());
    EXPECT_FALSE(engine->reported(real).known);
  }
}

}  // namespace
}  // namespace rave::sim::testing
