// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/guard.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "../src/guard_fence.hpp"
#include "guard_inputs.hpp"
#include "rave/base/random.hpp"
#include "rave/math/decompose.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/event.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Guard, PassesWhatIsWithinAllLimits) {
  const GuardOutput output = guard(GuardSpec{}, input(0.4, -0.3));
  EXPECT_EQ(output.acted, 0U);
  EXPECT_EQ(output.command, velocity_command(0.4, -0.3));
}

TEST(Guard, CapsKeepTheCurve) {
  GuardSpec spec;
  spec.max_speed_mps = 0.5;
  spec.max_turn_radps = 1;
  const GuardOutput fast = guard(spec, input(-2, 1));
  EXPECT_TRUE(fast.by(GuardLimit::kSpeed));
  EXPECT_FALSE(fast.by(GuardLimit::kTurn));
  EXPECT_EQ(fast.command.value[0], -0.5);
  EXPECT_DOUBLE_EQ(fast.command.value[1], 0.25);
  const GuardOutput turning = guard(spec, input(0.4, -4));
  EXPECT_TRUE(turning.by(GuardLimit::kTurn));
  EXPECT_DOUBLE_EQ(turning.command.value[0], 0.1);
  EXPECT_EQ(turning.command.value[1], -1);
  for (const double v : {1e300, -1e300, 1.7e308}) {
    EXPECT_LE(std::abs(guard(spec, input(v, v)).command.value[0]), 0.5) << v;
    EXPECT_LE(std::abs(guard(spec, input(v, v)).command.value[1]), 1.0) << v;
  }
}

TEST(Guard, EachReasonToStandStops) {
  GuardSpec spec;
  spec.world_timeout_s = 0.5;
  const auto stops_for = [&](GuardLimit limit, auto&& spoil) {
    GuardInput in = input(0.3, 0.1);
    spoil(in);
    const GuardOutput output = guard(spec, in);
    EXPECT_EQ(output.command, velocity_command(0, 0)) << to_string(limit);
    EXPECT_EQ(output.acted, 1U << static_cast<unsigned>(limit)) << to_string(limit);
    EXPECT_TRUE(stops(limit));
  };
  stops_for(GuardLimit::kStopped, [](GuardInput& in) { in.stopped = true; });
  stops_for(GuardLimit::kUnarmed, [](GuardInput& in) { in.armed = false; });
  stops_for(GuardLimit::kPoseLost, [](GuardInput& in) { in.pose_known = false; });
  stops_for(GuardLimit::kWorldLost, [](GuardInput& in) { in.world_age_s = 0.6; });
  stops_for(GuardLimit::kWorldLost, [](GuardInput& in) { in.world_age_s = kNan; });
  stops_for(GuardLimit::kWatchdog, [](GuardInput& in) { in.command_age_s = 1.1; });
  stops_for(GuardLimit::kWatchdog, [](GuardInput& in) { in.command_age_s = kInf; });
  for (const double bad : {kNan, kInf, -kInf}) {
    for (const std::size_t i : {0U, 1U, 2U, 3U}) {
      stops_for(GuardLimit::kBadCommand, [&](GuardInput& in) { in.command.value[i] = bad; });
    }
  }
  for (const CommandKind kind : {CommandKind::kGoal, CommandKind::kJoint, CommandKind::kValues}) {
    stops_for(GuardLimit::kBadCommand, [&](GuardInput& in) { in.command.kind = kind; });
  }
}

TEST(Guard, ASensorThatIsOlderThanItMayBeStopsAndIsNamed) {
  const auto with = [](std::vector<GuardSensor> sensors) {
    GuardInput in = input(0.3, 0.1);
    in.sensors = sensors;
    return guard(GuardSpec{}, in);
  };
  EXPECT_EQ(with({{0, 0.2, 0.2}, {1, 0, 0.3}}).command, velocity_command(0.3, 0.1));
  EXPECT_EQ(with({{0, 5, kInf}}).acted, 0U);
  for (const double age_s : {0.31, kInf, kNan}) {
    const GuardOutput output = with({{2, 0.1, 0.2}, {5, age_s, 0.3}, {6, 9, 0.3}});
    EXPECT_EQ(output.command, velocity_command(0, 0)) << age_s;
    EXPECT_EQ(output.acted, 1U << static_cast<unsigned>(GuardLimit::kSensorLost)) << age_s;
    EXPECT_EQ(output.lost_sensor, 5U);
  }
  EXPECT_TRUE(stops(GuardLimit::kSensorLost));
  EXPECT_EQ(to_string(GuardLimit::kSensorLost), "sensor lost");
}

TEST(Guard, AStandingRobotIsNotStopped) {
  GuardInput in = input(0, 0);
  in.stopped = true;
  EXPECT_EQ(guard(GuardSpec{}, in).acted, 0U);
}

TEST(Guard, OtherKindsPassIfFiniteAndFree) {
  GuardInput in = input(0, 0);
  in.expected = CommandKind::kJoint;
  in.command = {CommandKind::kJoint, 2, {0.5, 1, 0, 0}};
  EXPECT_EQ(guard(GuardSpec{}, in).command, in.command);
  in.stopped = true;
  EXPECT_EQ(guard(GuardSpec{}, in).command.kind, CommandKind::kNone);
  in.stopped = false;
  in.command.value[0] = kNan;
  EXPECT_EQ(guard(GuardSpec{}, in).command.kind, CommandKind::kNone);
  // The way to a goal is the actuator's own, so nobody could guard it.
  in.expected = CommandKind::kGoal;
  in.command = {CommandKind::kGoal, 3, {1, 1, 0, 0}};
  EXPECT_EQ(guard(GuardSpec{}, in).command.kind, CommandKind::kNone);
}

TEST(Guard, WorldLostFollowsThePolicy) {
  GuardSpec spec;
  spec.slow_speed_mps = 0.05;
  GuardInput in = input(0.5, 1);
  in.world_age_s = 10;
  spec.world_lost = WorldLostPolicy::kSlow;
  const GuardOutput slow = guard(spec, in);
  EXPECT_TRUE(slow.by(GuardLimit::kWorldLost));
  EXPECT_EQ(slow.command, velocity_command(0.05, 0.1));
  spec.world_lost = WorldLostPolicy::kIgnore;
  EXPECT_EQ(guard(spec, in).command, in.command);
}

TEST(Guard, InsideDistanceOfAConcaveFence) {
  const std::vector<Vec2> l_shape{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  EXPECT_DOUBLE_EQ(inside_distance(l_shape, {0.5, 2}), 0.5);
  EXPECT_DOUBLE_EQ(inside_distance(l_shape, {2, 0.25}), 0.25);
  EXPECT_DOUBLE_EQ(inside_distance(l_shape, {2, 3}), -1);
  EXPECT_DOUBLE_EQ(inside_distance(l_shape, {-3, -4}), -5);
}

TEST(Guard, FenceSlowsAndLetsTurn) {
  GuardSpec spec;
  spec.fence_W = square(2);
  const GuardOutput free = guard(spec, input(0.5, 0));
  EXPECT_EQ(free.acted, 0U);
  // 5 cm before the fence it may still creep, and turn as it likes.
  const GuardOutput near = guard(spec, input(0.5, 0.4, {1.75, 0, 0}));
  EXPECT_TRUE(near.by(GuardLimit::kFence));
  EXPECT_GT(near.command.value[0], 0.01);
  EXPECT_LT(near.command.value[0], 0.3);
  EXPECT_EQ(near.command.value[1], 0.4);
  const GuardOutput away = guard(spec, input(-0.5, 0, {1.75, 0, 0}));
  EXPECT_EQ(away.acted, 0U);
  const GuardOutput along = guard(spec, input(0.5, 0, {1.7, 0, kPi / 2}));
  EXPECT_EQ(along.acted, 0U);
}

TEST(Guard, WhoIsOutsideMayOnlyComeBack) {
  GuardSpec spec;
  spec.fence_W = square(2);
  EXPECT_EQ(guard(spec, input(0.5, 0, {3, 0, 0})).command.value[0], 0);
  EXPECT_EQ(guard(spec, input(-0.5, 0, {3, 0, 0})).command.value[0], -0.5);
  EXPECT_EQ(guard(spec, input(0.5, 0, {3, 0, kPi})).command.value[0], 0.5);
  EXPECT_EQ(guard(spec, input(0.5, 0.7, {3, 0, 0})).command, velocity_command(0, 0.7));
}

TEST(Guard, BrakesInTimeWhenMeasuredTooFast) {
  GuardSpec spec;
  spec.fence_W = square(2);
  GuardInput in = input(0.05, 0, {1.5, 0, 0});
  EXPECT_EQ(guard(spec, in).acted, 0U);
  in.velocity = {0.8, 0, 0};  // needs 0.72 m to stand
  EXPECT_EQ(guard(spec, in).command, velocity_command(0, 0));
  in.command = velocity_command(-0.05, 0);
  EXPECT_EQ(guard(spec, in).command, velocity_command(-0.05, 0));
}

TEST(Guard, KeepsApart) {
  GuardSpec spec;
  spec.separation_m = 0.3;
  const GuardNeighbour other{&disc(), {1.0, 0, 0}, {}};  // outlines 0.6 m apart
  GuardInput in = input(1.0, 0);
  in.neighbours = std::span(&other, 1);
  const GuardOutput toward = guard(spec, in);
  EXPECT_TRUE(toward.by(GuardLimit::kSeparation));
  const double v = toward.command.value[0];
  EXPECT_GT(v, 0.2);
  EXPECT_LE(v * 0.11 + v * v, 0.3 + 1e-9);
  in.command = velocity_command(-1, 0);
  EXPECT_EQ(guard(spec, in).acted, 0U);
  // Nearer than allowed: away, but no nearer.
  in.X_WR = {0.5, 0, 0};
  EXPECT_EQ(guard(spec, in).acted, 0U);
  in.command = velocity_command(0.2, 0);
  EXPECT_EQ(guard(spec, in).command.value[0], 0);
}

TEST(Guard, MayFleeFromWhoComesFaster) {
  GuardSpec spec;
  spec.separation_m = 0.3;
  const GuardNeighbour other{&disc(), {1.0, 0, 0}, {-2, 0, 0}};
  GuardInput in = input(-0.5, 0);
  in.neighbours = std::span(&other, 1);
  EXPECT_EQ(guard(spec, in).command.value[0], -0.5);
  in.command = velocity_command(0.5, 0);
  EXPECT_LT(guard(spec, in).command.value[0], 0.3);
}

TEST(Guard, ABodyWithCornersMayNotTurnIntoOthers) {
  world::Body bar;
  bar.shapes =
      world::make_prisms(std::vector<Vec2>{{-0.5, -0.05}, {0.5, -0.05}, {0.5, 0.05}, {-0.5, 0.05}},
                         0, 0.3)
          .value();
  GuardSpec spec;
  spec.separation_m = 0.05;
  const GuardNeighbour other{&disc(), {0, 0.72, 0}, {}};
  GuardInput in = input(0, 2, {0, 0, kPi / 2 - 0.8});
  in.body = &bar;
  in.radius_m = bar.radius_m();
  in.neighbours = std::span(&other, 1);
  for (int step = 0; step < 200; ++step) {
    const Command command = guard(spec, in).command;
    in.X_WR = integrate(in.X_WR, {command.value[0], 0, command.value[1]}, in.dt_s);
    const double gap_m = world::separation(bar, in.X_WR, *other.body, other.X_WB).distance_m;
    ASSERT_GE(gap_m, 0.05 - 1e-3) << step;
  }
}

/// A star-shaped polygon: simple, mostly concave.
std::vector<Vec2> random_fence(RandomStream& random) {
  std::vector<Vec2> fence;
  const int corners = 3 + static_cast<int>(random.uniform(0, 9));
  const double turn = random.uniform(0, 2 * kPi);
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * kPi * (i + random.uniform(0, 0.6)) / corners;
    const double radius_m = random.uniform(0.8, 4);
    const SinCos at = sincos(angle);
    fence.push_back({radius_m * at.cos, radius_m * at.sin});
  }
  if (random.bits() % 2 == 0) std::reverse(fence.begin(), fence.end());
  return fence;
}

/// What a hostile program might say.
Command hostile(RandomStream& random) {
  constexpr double kExtremes[] = {kNan, kInf, -kInf, 1e300, -1e300, 1e-300, 1e9, 50, -50};
  const auto value = [&](double scale) {
    if (random.bits() % 40 == 0) return kExtremes[random.bits() % 9];
    return random.uniform(-scale, scale);
  };
  const double v = value(3);
  return velocity_command(v, random.bits() % 3 == 0 ? 0 : value(random.bits() % 2 == 0 ? 2 : 20));
}

TEST(Guard, NoProgramLeavesAnyFence) {
  constexpr int kFences = 300;
  constexpr int kSteps = 500;
  int limited = 0;
  double deepest_m = 0;
  for (std::uint32_t f = 0; f < kFences; ++f) {
    RandomStream random(7, f, 1, 0);
    GuardSpec spec;
    spec.fence_W = random_fence(random);
    ASSERT_TRUE(decompose(spec.fence_W)) << f;
    spec.deceleration_mps2 = random.uniform(0.1, 3);
    spec.reaction_s = random.uniform(0, 0.3);
    if (f % 4 == 0) spec.max_speed_mps = random.uniform(0.1, 2);
    GuardInput in = input(0, 0);
    in.radius_m = random.uniform(0.05, 0.5);
    in.dt_s = random.bits() % 3 == 0 ? 0.1 : 0.01;
    do {
      in.X_WR = {random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-kPi, kPi)};
    } while (random.bits() % 64 != 0 &&
             inside_distance(spec.fence_W, in.X_WR.position()) < in.radius_m);
    double least_m = std::min(0.0, inside_distance(spec.fence_W, in.X_WR.position()) - in.radius_m);
    for (int step = 0; step < kSteps; ++step) {
      // The same for a while, so that it gets somewhere; then straight at the fence again.
      if (step % 25 == 0) in.command = hostile(random);
      const GuardOutput output = guard(spec, in);
      limited += output.by(GuardLimit::kFence) ? 1 : 0;
      const double v = output.command.value[0];
      const double w = output.command.value[1];
      ASSERT_TRUE(std::isfinite(v) && std::isfinite(w));
      // In small parts: the body may not cross between two steps either.
      constexpr int kParts = 5;
      const Pose2 X_before = in.X_WR;
      for (int part = 1; part <= kParts; ++part) {
        const Pose2 X_WR = integrate(X_before, {v, 0, w}, in.dt_s * part / kParts);
        const double clear_m = inside_distance(spec.fence_W, X_WR.position()) - in.radius_m;
        ASSERT_GE(clear_m, least_m - 1e-3) << "fence " << f << ", step " << step;
        deepest_m = std::min(deepest_m, clear_m - least_m);
      }
      in.X_WR = integrate(X_before, {v, 0, w}, in.dt_s);
      in.velocity = {v, 0, w};
      // Who was outside may come in, and not out again.
      const double now_m = inside_distance(spec.fence_W, in.X_WR.position()) - in.radius_m;
      least_m = std::max(least_m, std::min(0.0, now_m));
    }
  }
  EXPECT_GT(limited, 1000);
  EXPECT_GE(deepest_m, -1e-3);
  RecordProperty("deepest_um", static_cast<int>(1e6 * deepest_m));
}

TEST(Guard, StraightAtTheFenceFromEveryAngle) {
  GuardSpec spec;
  spec.fence_W = {{-2, -2}, {2, -2}, {2, 2}, {0, 0.5}, {-2, 2}};
  for (int degrees = 0; degrees < 360; degrees += 9) {
    for (const double speed : {0.25, 0.5, 5.0, -1.0}) {
      GuardInput in = input(speed, 0, {0, -0.6, deg_to_rad(degrees)});
      for (int step = 0; step < 1200; ++step) {
        const Command command = guard(spec, in).command;
        in.velocity = {command.value[0], 0, command.value[1]};
        in.X_WR = integrate(in.X_WR, in.velocity, in.dt_s);
        ASSERT_GE(inside_distance(spec.fence_W, in.X_WR.position()) - in.radius_m, -1e-3)
            << degrees << " deg at " << speed;
      }
      // It came near, so it was the guard that held it.
      EXPECT_LT(inside_distance(spec.fence_W, in.X_WR.position()) - in.radius_m, 0.02)
          << degrees << " deg at " << speed;
    }
  }
}

/// A robot that needs its stated deceleration and reaction to obey.
TEST(Guard, ARobotThatBrakesAsStatedStaysInside) {
  for (const double deceleration : {0.3, 1.0}) {
    for (const double delay_s : {0.0, 0.1}) {
      GuardSpec spec;
      spec.fence_W = square(2);
      spec.deceleration_mps2 = deceleration;
      spec.reaction_s = 0.12;
      GuardInput in = input(1.0, 0, {-1.5, 0, 0});
      std::vector<double> orders(static_cast<std::size_t>(delay_s / in.dt_s) + 1, 0.0);
      double v = 0;
      for (int step = 0; step < 3000; ++step) {
        orders.push_back(guard(spec, in).command.value[0]);
        const double order =
            orders[orders.size() - 1 - static_cast<std::size_t>(delay_s / in.dt_s)];
        v = order < v ? std::max(order, v - deceleration * in.dt_s)
                      : std::min(order, v + 2 * in.dt_s);
        in.X_WR.x += v * in.dt_s;
        in.velocity = {v, 0, 0};
        ASSERT_LE(in.X_WR.x + in.radius_m, 2 + 1e-3)
            << deceleration << " m/s2, " << delay_s << " s, step " << step;
      }
      EXPECT_GT(in.X_WR.x + in.radius_m, 1.9);
    }
  }
}

TEST(Names, AreGivenToAllEventsAndLimits) {
  for (const auto& [first, last] : {std::pair(EventKind::kContact, EventKind::kDriverBack),
                                    std::pair(EventKind::kGuardSlowed, EventKind::kLease)}) {
    for (auto kind = first; kind <= last;
         kind = static_cast<EventKind>(static_cast<int>(kind) + 1)) {
      EXPECT_NE(to_string(kind), "unknown") << static_cast<int>(kind);
    }
  }
  EXPECT_EQ(to_string(GuardLimit::kUnarmed), "not armed");
  EXPECT_EQ(to_string(GuardLimit::kSeparation), "separation");
}

}  // namespace
}  // namespace rave::sim
