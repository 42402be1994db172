// SPDX-License-Identifier: Apache-2.0
#include "obedient.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineGuard, ARealRobotStandsUntilArmed) {
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.program = program<Drive>({{"v", 0.3}});
  type.guard = GuardSpec{};
  type.guard->arm = true;
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  const auto before = run(*engine, 20);
  EXPECT_FALSE(engine->armed(robot));
  for (const Command& command : Obedient::told()) EXPECT_EQ(command, velocity_command(0, 0));
  ASSERT_EQ(of_kind(before, EventKind::kGuardStopped).size(), 1U);
  EXPECT_EQ(before.back().detail, static_cast<std::uint32_t>(GuardLimit::kUnarmed));
  engine->arm(robot);
  EXPECT_EQ(of_kind(run(*engine, 1), EventKind::kArmed).size(), 1U);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  // A stop ends what arming allowed.
  engine->stop(robot);
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
  engine->arm(robot);
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
  engine->release(robot);
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
  engine->arm(robot);
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
}

TEST(EngineGuard, ARealRobotWithoutAGuardSectionIsGuardedAllTheSame) {
  EngineSpec spec;
  RobotType type = obedient_type({{"gap_s", 0.3}, {"gap_end_s", 1.2}});
  type.program = program<Drive>({{"v", 0.3}, {"quiet_after", 200}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 79);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  const auto lost = of_kind(run(*engine, 10), EventKind::kGuardStopped);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost[0].detail, static_cast<std::uint32_t>(GuardLimit::kPoseLost));
  EXPECT_EQ(lost[0].step, 80U);  // as the pose goes stale
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
  run(*engine, 60);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  // The program fell silent at 2 s; the controller does not care, the guard does after 1 s.
  const auto silent = of_kind(run(*engine, 160), EventKind::kGuardStopped);
  ASSERT_EQ(silent.size(), 1U);
  EXPECT_EQ(silent[0].detail, static_cast<std::uint32_t>(GuardLimit::kWatchdog));
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
  EXPECT_TRUE(engine->armed(robot));
}

TEST(EngineGuard, SaysWhatARobotLacksToMove) {
  EngineSpec spec;
  RobotType type = obedient_type({{"gap_s", 0.3}, {"gap_end_s", 1.2}});
  type.program = program<Drive>({{"v", 0.3}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  EXPECT_EQ(engine->lacks(robot), "") << "nothing was heard yet";
  run(*engine, 20);
  EXPECT_EQ(engine->lacks(robot), "");
  run(*engine, 69);
  EXPECT_EQ(engine->lacks(robot), "pose lost: its pose is not reported");
  EXPECT_TRUE(engine->armed(robot));
  run(*engine, 60);
  EXPECT_EQ(engine->lacks(robot), "");
}

/// Beside the pose a sensor that is silent between 0.3 and 1.2 s.
EngineSpec with_second_sensor(SampleTiming timing, std::optional<double> max_age_s,
                              Numbers second = {{"gap_s", 0.3}, {"gap_end_s", 1.2}}) {
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.program = program<Drive>({{"v", 0.3}});
  SensorSpec sensor = real_sensor<Recording>("compass", second);
  sensor.timing = timing;
  sensor.max_age_s = max_age_s;
  type.sensors.push_back(std::move(sensor));
  add_robot(spec, std::move(type));
  return spec;
}

TEST(EngineGuard, ASensorThatFallsSilentStopsTheRobotUntilItSpeaksAgain) {
  struct Case {
    SampleTiming timing;
    std::optional<double> max_age_s;
    std::uint64_t stops_at;
    const char* text;
  };
  // The newest sample before the gap is of 0.294 s; three periods of 7 ms are less than 0.2 s.
  for (const Case& c :
       {Case{SampleTiming::kPeriodic, std::nullopt, 50, "0.2"},
        Case{SampleTiming::kPeriodic, 0.4, 70, "0.4"}, Case{SampleTiming::kUnknown, 0.4, 70, "0.4"},
        Case{SampleTiming::kEvents, 0.4, 70, "0.4"}}) {
    const auto engine = make_engine(with_second_sensor(c.timing, c.max_age_s));
    EXPECT_TRUE(run(*engine, static_cast<int>(c.stops_at)).empty());
    EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
    const auto events = run(*engine, static_cast<int>(120 - c.stops_at));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, EventKind::kGuardStopped);
    EXPECT_EQ(events[0].detail, static_cast<std::uint32_t>(GuardLimit::kSensorLost));
    EXPECT_EQ(events[0].step, c.stops_at);
    EXPECT_EQ(events[0].text,
              fmt::format("sensor lost: `compass` has given no sample for more than {} s", c.text));
    for (std::size_t i = c.stops_at; i < Obedient::told().size(); ++i) {
      EXPECT_EQ(Obedient::told()[i], velocity_command(0, 0)) << i;
    }
    run(*engine, 2);
    EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  }
}

TEST(EngineGuard, ASensorThatHasNotSpokenYetHoldsTheRobot) {
  const auto engine =
      make_engine(with_second_sensor(SampleTiming::kPeriodic, {}, {{"first_s", 0.2}}));
  const auto events = run(*engine, 20);
  ASSERT_EQ(of_kind(events, EventKind::kGuardStopped).size(), 1U);
  for (const Command& command : Obedient::told()) EXPECT_EQ(command, velocity_command(0, 0));
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
}

TEST(EngineGuard, SilenceOfASensorOfEventsOrOfUnknownPaceIsNoFault) {
  for (const SampleTiming timing : {SampleTiming::kEvents, SampleTiming::kUnknown}) {
    const auto engine = make_engine(with_second_sensor(timing, {}));
    EXPECT_TRUE(run(*engine, 120).empty());
    EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  }
}

TEST(EngineGuard, ASensorOfEventsWhoseDeviceIsGoneStopsTheRobot) {
  const auto engine = make_engine(with_second_sensor(SampleTiming::kEvents, {}, {{"fail_s", 0.1}}));
  const auto events = run(*engine, 20);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].kind, EventKind::kDriverFailed);
  EXPECT_EQ(events[1].kind, EventKind::kGuardStopped);
  EXPECT_EQ(events[1].text, "sensor lost: the driver of `compass` has failed");
  EXPECT_EQ(engine->lacks(RobotId(0)), events[1].text);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
}

TEST(EngineGuard, TheAgeOfThePoseSourceIsItsStaleness) {
  EngineSpec spec;
  RobotType type = obedient_type({{"gap_s", 0.3}, {"gap_end_s", 0.7}});
  type.program = program<Drive>({{"v", 0.3}});
  type.sensors[0].timing = SampleTiming::kPeriodic;
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  EXPECT_TRUE(run(*engine, 100).empty());
}

TEST(EngineGuard, APeriodicDriverHasToSayItsPeriod) {
  EngineSpec spec = with_second_sensor(SampleTiming::kPeriodic, {}, {{"no_period", 1}});
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine.has_value());
  EXPECT_EQ(engine.error().text(),
            "robot `r0`, sensor `compass` (driver `compass`): is periodic, but declared a period "
            "of 0 s");
}

TEST(EngineGuard, ARobotWithoutAPoseDoesNotMove) {
  EngineSpec spec;
  RobotType type = obedient_type({{"first_s", 0.2}});
  type.program = program<Drive>({{"v", 0.3}});
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 20);
  for (const Command& command : Obedient::told()) EXPECT_EQ(command, velocity_command(0, 0));
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
}

TEST(EngineGuard, NotANumberNeverReachesHardware) {
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.program = program<Drive>({{"v", 0.3}, {"nan_at", 5}});
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 20);
  for (const Command& command : Obedient::told()) EXPECT_TRUE(std::isfinite(command.value[0]));
}

TEST(EngineGuard, HardwareIsToldToStandWhenTheRunEnds) {
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.program = program<Drive>({{"v", 0.3}});
  add_robot(spec, std::move(type));
  auto engine = make_engine(std::move(spec));
  run(*engine, 5);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
  engine.reset();
  EXPECT_EQ(Obedient::told().back(), velocity_command(0, 0));
}

TEST(EngineGuard, AStopLatchesForSimulatedRobotsToo) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Drive>({{"v", 0.5}});
  const RobotId one = add_robot(spec, std::move(type));
  const RobotId two = add_twin(spec, {0, 2, 0});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  engine->stop(RobotId());
  const double x_m = engine->true_pose(one).x;
  const auto events = run(*engine, 50);
  EXPECT_EQ(of_kind(events, EventKind::kStopped).size(), 2U);
  EXPECT_EQ(engine->true_pose(one).x, x_m);
  EXPECT_EQ(engine->true_pose(two).x, x_m);
  EXPECT_EQ(engine->inputs_by_hand(), 2U);
  engine->arm(RobotId());
  run(*engine, 10);
  EXPECT_EQ(engine->true_pose(one).x, x_m);
  engine->release(one);
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(one).x, x_m + 0.05, 1e-12);
  EXPECT_EQ(engine->true_pose(two).x, x_m);
}

TEST(EngineGuard, WorldLostStops) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Drive>({{"v", 0.5}});
  type.guard = GuardSpec{};
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  engine->set_world_age(from_seconds(0.4));
  run(*engine, 10);
  const double x_m = engine->true_pose(robot).x;
  EXPECT_NEAR(x_m, 0.1, 1e-12);
  engine->set_world_age(from_seconds(0.6));
  const auto events = of_kind(run(*engine, 100), EventKind::kGuardStopped);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].detail, static_cast<std::uint32_t>(GuardLimit::kWorldLost));
  EXPECT_EQ(engine->true_pose(robot).x, x_m);
}

TEST(EngineGuard, ARecklessRobotStaysInItsFence) {
  EngineSpec spec;
  RobotType type = reckless_type();
  type.program = program<Drive>({{"v", 4}, {"w", 0.3}});
  type.guard = fenced({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  std::size_t slowed = 0;
  for (int step = 0; step < 3000; ++step) {
    slowed += of_kind(run(*engine, 1), EventKind::kGuardSlowed).size();
    const Pose2 X_WR = engine->true_pose(robot);
    ASSERT_LE(std::max(std::abs(X_WR.x), std::abs(X_WR.y)), 0.85 + 1e-3) << step;
  }
  EXPECT_GE(slowed, 1U);
  EXPECT_LT(slowed, 30U);  // once per beginning, not once per step
}

TEST(EngineGuard, RobotsKeepApartAndTouchWithout) {
  for (const bool guarded : {true, false}) {
    EngineSpec spec;
    RobotType hunter = simulated_type();
    hunter.program = program<Drive>({{"v", 1}});
    if (guarded) {
      hunter.guard = GuardSpec{};
      hunter.guard->separation_m = 0.2;
    }
    const RobotId a = add_robot(spec, std::move(hunter), {0, 0, 0});
    RobotType stander = simulated_type();
    stander.program = program<Drive>({{"v", 0.1}});
    const RobotId b = add_robot(spec, std::move(stander), {2, 0.05, kPi});
    const auto engine = make_engine(std::move(spec));
    double least_m = 1e9;
    std::vector<Event> events;
    // Later the other one comes nearer by itself.
    for (int step = 0; step < 180; ++step) {
      const auto of_step = run(*engine, 1);
      events.insert(events.end(), of_step.begin(), of_step.end());
      const auto& bodies = engine->spec().world.robots;
      least_m = std::min(least_m, world::separation(bodies[a.value()], engine->true_pose(a),
                                                    bodies[b.value()], engine->true_pose(b))
                                      .distance_m);
    }
    const auto contacts = of_kind(events, EventKind::kContact).size();
    if (guarded) {
      EXPECT_GE(least_m, 0.2 - 2e-3);
      EXPECT_LT(least_m, 0.6);
      EXPECT_EQ(contacts, 0U);
    } else {
      EXPECT_GE(contacts, 1U);
    }
  }
}

TEST(EngineGuard, TheHashKnowsInputsAndNotThreads) {
  const auto hash = [](unsigned threads, int stop_at) {
    EngineSpec spec;
    spec.threads = threads;
    RobotType type = reckless_type();
    type.sensors.push_back(laser(8, 3, 3));
    type.program = program<Roam>();
    type.guard = fenced({{-3, -3}, {3, -3}, {3, 3}, {-3, 3}});
    type.guard->separation_m = 0.05;
    type.guard->max_speed_mps = 0.4;
    add_robot(spec, std::move(type), {-2, -2, 0});
    for (std::uint32_t i = 1; i < 100; ++i) {
      const std::uint32_t row = i / 10;
      add_twin(spec, {-2 + 0.45 * (i % 10), -2 + 0.45 * row, 0.7 * (i % 9)});
    }
    const auto engine = make_engine(std::move(spec));
    run(*engine, stop_at);
    engine->stop(RobotId(3));
    run(*engine, 100 - stop_at);
    return engine->hash();
  };
  const RunHash one = hash(1, 40);
  EXPECT_EQ(hash(1, 40), one);
  EXPECT_EQ(hash(2, 40), one);
  EXPECT_EQ(hash(3, 40), one);
  EXPECT_NE(hash(1, 41), one);
}

}  // namespace
}  // namespace rave::sim::testing
