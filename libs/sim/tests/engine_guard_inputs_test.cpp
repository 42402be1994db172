// SPDX-License-Identifier: Apache-2.0
// What the engine tells the guard of a robot.
#include <cmath>

#include "guard_inputs.hpp"
#include "obedient.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kDt_s = 0.01;
constexpr double kDisc_m = 0.15;

/// Drives by itself, whether its program has said anything yet or not.
class Eager final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup&) override { return {}; }
  Command control(const ControlInput&) override { return velocity_command(0.3, 0); }
};

double written_mps(std::size_t step) { return Obedient::told().at(step).value[0]; }

TEST(EngineGuardInputs, TheOlderThePoseTheSlowerTowardsTheFence) {
  EngineSpec spec;
  RobotType type = obedient_type({{"gap_s", 0.3}, {"gap_end_s", 1.2}});
  type.program = program<Drive>({{"v", 2}});
  type.guard = fenced(square(1));
  const GuardSpec limits = *type.guard;
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 79);
  ASSERT_EQ(Obedient::told().size(), 79U);
  // It stands at the origin, but might have gone as it was told since the last sample before the
  // gap, which is of 0.294 s.
  double fastest_mps = written_mps(29);
  const double a = limits.deceleration_mps2;
  const double delay_s = kDt_s + limits.reaction_s;
  for (std::size_t step = 30; step < 79; ++step) {
    const double age_s = kDt_s * static_cast<double>(step) - 0.294;
    const double way_m = 1 - kDisc_m - age_s * fastest_mps;
    const double v_mps = std::sqrt(a * a * delay_s * delay_s + 2 * a * way_m) - a * delay_s;
    ASSERT_NEAR(written_mps(step), v_mps, 1e-4) << step;
    fastest_mps = std::max(fastest_mps, written_mps(step));
  }
  EXPECT_LT(written_mps(78), 0.7 * written_mps(29));
}

TEST(EngineGuardInputs, WhoIsMeasuredTooFastIsToldToStand) {
  EngineSpec spec;
  RobotType type = obedient_type({{"vx", 0.8}});
  type.program = program<Drive>({{"v", 0.05}});
  type.guard = fenced(square(2));
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  // From 0.8 m/s it needs 0.72 m, which it has until it is at 1.13 m.
  run(*engine, 130);
  EXPECT_EQ(written_mps(129), 0.05);
  const auto slowed = of_kind(run(*engine, 20), EventKind::kGuardSlowed);
  ASSERT_EQ(slowed.size(), 1U);
  EXPECT_EQ(slowed[0].detail, static_cast<std::uint32_t>(GuardLimit::kFence));
  EXPECT_EQ(written_mps(149), 0);
}

TEST(EngineGuardInputs, WhoSlidesAlongAWallStaysInItsFence) {
  // The wall leads whoever drives ahead to the left, where no arc of the command goes.
  EngineSpec spec;
  const double back_m = 0.05 * std::sqrt(0.5);
  spec.world.obstacles.push_back(box({0.5 + back_m, -back_m, kPi / 4}, 6, 0.1, 1, "wall"));
  RobotType type = reckless_type();
  type.program = program<Drive>({{"v", 0.5}});
  type.guard = fenced({{-5, -5}, {5, -5}, {5, 0.6}, {-5, 0.6}});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  for (int step = 0; step < 1000; ++step) {
    run(*engine, 1);
    ASSERT_LE(engine->true_pose(robot).y, 0.6 - kDisc_m + 1e-3) << step;
  }
  EXPECT_GT(engine->true_pose(robot).y, 0.6 - kDisc_m - 0.1) << "it slid";
}

TEST(EngineGuardInputs, BeforeItsProgramHasSaidAnythingARobotStands) {
  static constexpr ControllerOps kEager = detail::controller_ops<Eager>();
  EngineSpec spec;
  RobotType type = obedient_type({});
  type.controllers[0].ops = &kEager;
  type.program = program<Drive>({{"v", 0.3}}, 100, 50);
  add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 50);
  for (const Command& command : Obedient::told()) EXPECT_EQ(command, velocity_command(0, 0));
  const auto stopped = of_kind(events, EventKind::kGuardStopped);
  ASSERT_EQ(stopped.size(), 1U);
  EXPECT_EQ(stopped[0].detail, static_cast<std::uint32_t>(GuardLimit::kWatchdog));
  run(*engine, 1);
  EXPECT_EQ(Obedient::told().back(), velocity_command(0.3, 0));
}

/// A robot that keeps 0.2 m away from others drives ahead from the origin at `v_mps`; another one
/// comes towards it from `from_m` at `other_mps`. Looks at each command until they are near.
void expect_seen_in_time(double v_mps, double from_m, double other_mps) {
  EngineSpec spec;
  RobotType type = reckless_type();
  type.program = program<Drive>({{"v", v_mps}});
  type.guard = GuardSpec{};
  type.guard->separation_m = 0.2;
  const GuardSpec limits = *type.guard;
  const RobotId robot = add_robot(spec, std::move(type));
  RobotType comes = reckless_type();
  comes.program = program<Drive>({{"v", other_mps}});
  const RobotId other = add_robot(spec, std::move(comes), {from_m, 0, kPi});
  const auto engine = make_engine(std::move(spec));
  run(*engine, 2);  // from then on the other one is seen to move
  double slowest_mps = v_mps;
  for (int step = 0; step < 2000; ++step) {
    const double gap_m = engine->true_pose(other).x - engine->true_pose(robot).x - 2 * kDisc_m;
    if (gap_m < 0.5) break;
    run(*engine, 1);
    const double told_mps = engine->actuator_command(robot, 0).value[0];
    slowest_mps = std::min(slowest_mps, told_mps);
    if (told_mps < 1e-3) continue;
    // Its own way until it stands, and what the other one comes nearer until it obeys.
    const double delay_s = kDt_s + limits.reaction_s;
    const double way_m = told_mps * delay_s + told_mps * told_mps / (2 * limits.deceleration_mps2);
    ASSERT_LE(way_m + other_mps * delay_s, gap_m - limits.separation_m + 1e-3)
        << "step " << step << ", told " << told_mps << " m/s";
  }
  EXPECT_LT(slowest_mps, v_mps) << "they met";
}

TEST(EngineGuardInputs, OthersAreLookedForAsFarAsAFastRobotNeedsToStand) {
  expect_seen_in_time(3, 12, 0);
}

TEST(EngineGuardInputs, OthersThatComeAreSeenBeforeTheyAreNear) { expect_seen_in_time(1, 10, 2); }

}  // namespace
}  // namespace rave::sim::testing
