// SPDX-License-Identifier: Apache-2.0
#include "rave/math/transform.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineOrder, AProgramSeesTheWorldOfItsOwnStepAndMovesItInTheSame) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Counter>("counter"));
  type.program = program<Diary>({{"v", 1}});
  const RobotId robot = add_robot(spec, std::move(type), {2, 0, 0});
  const auto engine = make_engine(std::move(spec));
  for (int k = 0; k < 5; ++k) {
    run(*engine, 1);
    EXPECT_EQ(engine->time().ns, k * 10'000'000);
    // The snapshot is what was sensed, the true pose what came of it.
    EXPECT_NEAR(engine->snapshot().pose(robot).x, 2 + 0.01 * k, 1e-12);
    EXPECT_NEAR(engine->true_pose(robot).x, 2 + 0.01 * (k + 1), 1e-12);
  }
  ASSERT_EQ(Diary::entries().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const Diary::Entry& entry = Diary::entries()[k];
    EXPECT_EQ(entry.now_ns, static_cast<std::int64_t>(k) * 10'000'000);
    EXPECT_EQ(entry.stamp_ns, entry.now_ns);
    EXPECT_EQ(entry.sequence, k + 1);
    EXPECT_EQ(entry.fresh, 1U);
    EXPECT_EQ(entry.first, static_cast<double>(k + 1));
    EXPECT_NEAR(entry.reported_x_m, 2 + 0.01 * static_cast<double>(k), 1e-12);
  }
}

TEST(EngineOrder, PeriodsAndPhasesAreCountedInSteps) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Counter>("counter", {}, 3));
  type.sensors.back().phase_steps = 1;
  type.program = program<Diary>({}, 2, 1);
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 8);
  // Samples in steps 1, 4 and 7; decisions in 1, 3, 5 and 7.
  ASSERT_EQ(Diary::entries().size(), 4U);
  const std::uint32_t sequence[] = {1, 1, 2, 3};
  const std::uint32_t fresh[] = {1, 0, 1, 1};
  const std::int64_t stamp_ms[] = {10, 10, 40, 70};
  for (std::size_t i = 0; i < 4; ++i) {
    const Diary::Entry& entry = Diary::entries()[i];
    EXPECT_EQ(entry.now_ns, static_cast<std::int64_t>(2 * i + 1) * 10'000'000);
    EXPECT_EQ(entry.sequence, sequence[i]);
    EXPECT_EQ(entry.fresh, fresh[i]);
    EXPECT_EQ(entry.stamp_ns, stamp_ms[i] * 1'000'000);
  }
}

TEST(EngineOrder, AProgramIsToldTheReportedPoseAndPhysicsUsesTheTrueOne) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Beacon>("beacon", {{"offset_m", 5}}));
  type.sensors.push_back(laser());
  type.pose_from = 0;
  type.program = program<Diary>({{"v", 0.5}});
  const RobotId robot = add_robot(spec, std::move(type));
  spec.world.obstacles.push_back(box({1.5, 0, 0}, 1, 1));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 10);
  EXPECT_NEAR(Diary::entries()[9].reported_x_m, 5 + 0.045, 1e-12);
  EXPECT_NEAR(engine->reported(robot).pose.x_m, 5 + 0.045, 1e-12);
  EXPECT_NEAR(engine->true_pose(robot).x, 0.05, 1e-12);
  EXPECT_NEAR(range(*engine, robot, 1), 1 - 0.045, 1e-6);
}

TEST(EngineOrder, LatencyHoldsAReadingBackAndKeepsItsStamp) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Counter>("counter"));
  type.sensors.back().processing.latency_s = 0.03;
  type.program = program<Diary>();
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 6);
  EXPECT_EQ(Diary::entries()[2].sequence, 0U);
  EXPECT_EQ(Diary::entries()[3].sequence, 1U);
  EXPECT_EQ(Diary::entries()[5].stamp_ns, 20'000'000);
  EXPECT_EQ(Diary::entries()[5].first, 3);
}

TEST(EngineCommands, AControllersWatchdogStopsARobotWhoseProgramFallsSilent) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Drive>({{"v", 1}, {"quiet_after", 5}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 40);
  // Last command in step 4; from step 15 on it is older than 0.1 s.
  EXPECT_NEAR(engine->true_pose(robot).x, 0.15, 1e-12);
  EXPECT_EQ(engine->commands_given(robot), 5U);
  EXPECT_TRUE(engine->program_alive(robot));
}

TEST(EngineCommands, ARobotWithoutProgramStandsAndItsSensorsWork) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Counter>("counter"));
  const RobotId robot = add_robot(spec, std::move(type), {1, 2, 0.5});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 7);
  EXPECT_EQ(engine->true_pose(robot), (Pose2{1, 2, 0.5}));
  EXPECT_EQ(engine->sensor(robot, 0).header->sequence, 7U);
  EXPECT_EQ(engine->sensor(robot, 0).header->fresh, 0U);
  EXPECT_FALSE(engine->program_alive(robot));
}

TEST(EngineContact, IsToldOnceWhileARobotPressesOnAWall) {
  EngineSpec spec;
  RobotType type = simulated_type();
  type.program = program<Drive>({{"v", 1}});
  const RobotId robot = add_robot(spec, std::move(type));
  spec.world.obstacles.push_back(box({1, 0, 0}, 1, 3));
  const auto engine = make_engine(std::move(spec));
  const auto contacts = of_kind(run(*engine, 100), EventKind::kContact);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].robot, robot);
  EXPECT_EQ(contacts[0].other, BodyId(0));
  EXPECT_NEAR(engine->true_pose(robot).x, 0.5 - 0.15, 2e-4);
  EXPECT_TRUE(engine->snapshot().touch(robot).touching);
  EXPECT_NEAR(engine->snapshot().touch(robot).direction_W.x, 1, 1e-9);
}

TEST(EngineContact, ARobotThatARealOneDrivesIntoAWallIsPinnedOnce) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, simulated_type(), {1, 0, 0});
  const RobotId real = add_robot(spec, real_type({{"vx", 0.5}}));
  spec.world.obstacles.push_back(box({1.16, 0, 0}, 0.02, 3));
  spec.world.obstacles.push_back(box({0.5, 0.2, 0}, 2, 0.05));
  spec.world.obstacles.push_back(box({0.5, -0.2, 0}, 2, 0.05));
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 190);
  const auto pinned = of_kind(events, EventKind::kPinned);
  ASSERT_EQ(pinned.size(), 1U);
  EXPECT_EQ(pinned[0].robot, robot);
  EXPECT_EQ(pinned[0].other, engine->snapshot().body_of(real));
  // The real one went its way all the same; the last pose came at 1.890 s.
  EXPECT_NEAR(engine->snapshot().pose(real).x, 0.5 * 1.89, 1e-9);
  // Both start again after a reset: so does the episode.
  ASSERT_TRUE(engine->reset().has_value());
  EXPECT_EQ(of_kind(run(*engine, 190), EventKind::kPinned).size(), 1U);
}

TEST(EngineCreate, RefusesPoseSourcesThatCannotWork) {
  EngineSpec nowhere;
  RobotType type = real_type({});
  type.pose_from.reset();
  add_robot(nowhere, std::move(type));
  const auto a = Engine::create(std::move(nowhere));
  ASSERT_FALSE(a.has_value());
  EXPECT_EQ(a.error().text(), "robot `r0` is real, so it needs a source of its pose: `pose_from`");

  EngineSpec blind;
  type = real_type({});
  type.sensors.push_back(virtual_sensor<Beacon>("beacon"));
  type.pose_from = 1;
  add_robot(blind, std::move(type));
  const auto b = Engine::create(std::move(blind));
  ASSERT_FALSE(b.has_value());
  EXPECT_EQ(b.error().text(),
            "robot `r0` is real, so `pose_from` needs a real sensor, but `beacon` is virtual");

  EngineSpec wrong;
  type = simulated_type();
  type.sensors.push_back(laser());
  type.pose_from = 0;
  add_robot(wrong, std::move(type));
  const auto c = Engine::create(std::move(wrong));
  ASSERT_FALSE(c.has_value());
  EXPECT_EQ(c.error().text(),
            "robot `r0`: `pose_from` needs a pose or odometry, but `laser` gives "
            "ranges");
}

TEST(EngineCreate, ALiveDriverNeedsAClock) {
  EngineSpec spec;
  add_robot(spec, real_type({{"live", 1}}));
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine.has_value());
  EXPECT_EQ(engine.error().text(),
            "robot `r0`, sensor `mocap` (driver `mocap`): follows the wall clock, but the run is "
            "stepped");
}

}  // namespace
}  // namespace rave::sim::testing
