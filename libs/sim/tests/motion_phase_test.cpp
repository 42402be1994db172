// SPDX-License-Identifier: Apache-2.0
// The broad phase changes nothing but the time that a step takes.
#include "../src/motion_phase.hpp"

#include <gtest/gtest.h>

#include "contact_arena.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kStep_s = 0.1;

/// What the step is by definition: the resolver for each robot in turn, and no broad phase.
void step_one_by_one(ContactArena& arena, Resolver& resolver) {
  double slack_m = 0;
  for (std::uint32_t r = 0; r < arena.movers.size(); ++r) {
    if (!arena.movers[r].simulated) continue;
    const Twist2& twist = arena.proposal[r];
    const double speed_mps = std::sqrt(twist.vx * twist.vx + twist.vy * twist.vy);
    slack_m = std::max(slack_m, (speed_mps + std::abs(twist.wz) * resolver.radius_m(r)) * kStep_s);
  }
  arena.notes.clear();
  for (std::uint32_t r = 0; r < arena.movers.size(); ++r) {
    if (!arena.movers[r].simulated) continue;
    const Twist2& twist = arena.proposal[r];
    arena.limited[r] = 0;
    arena.velocity[r] = twist;
    if (twist == Twist2{}) continue;
    const Pose2 X_before = arena.movers[r].X_WR;
    const Pose2 X_wanted = integrate(X_before, twist, kStep_s);
    const std::size_t first = arena.notes.size();
    resolver.move(r, {X_wanted.x - X_before.x, X_wanted.y - X_before.y, twist.wz * kStep_s},
                  *arena.snapshot, slack_m, arena.movers, arena.notes);
    if (arena.notes.size() == first) {
      arena.movers[r].X_WR = X_wanted;
      continue;
    }
    arena.limited[r] = 1;
    Pose2& X_WR = arena.movers[r].X_WR;
    X_WR.yaw = wrap_angle(X_WR.yaw);
    arena.velocity[r] = twist_between(X_before, X_WR, kStep_s);
  }
  arena.refresh();
}

void expect_equal(const ContactArena& a, const ContactArena& b, int world, int step) {
  ASSERT_EQ(a.notes.size(), b.notes.size()) << "world " << world << ", step " << step;
  for (std::size_t i = 0; i < a.notes.size(); ++i) {
    ASSERT_EQ(a.notes[i].robot, b.notes[i].robot) << "world " << world << ", step " << step;
    ASSERT_EQ(a.notes[i].other, b.notes[i].other) << "world " << world << ", step " << step;
    ASSERT_EQ(a.notes[i].direction_W, b.notes[i].direction_W);
  }
  for (std::size_t r = 0; r < a.movers.size(); ++r) {
    ASSERT_EQ(a.movers[r].X_WR, b.movers[r].X_WR)
        << "world " << world << ", robot " << r << ", step " << step;
    ASSERT_EQ(a.velocity[r], b.velocity[r]) << "world " << world << ", robot " << r;
    ASSERT_EQ(a.limited[r], b.limited[r]) << "world " << world << ", robot " << r;
  }
}

world::Body any_robot(RandomStream& random) {
  switch (random.bits() % 5) {
    case 0:
      return square_robot(random.uniform(0.05, 0.6), random.uniform(0.05, 0.4));
    case 1:  // turns about a point far off its middle
      return round_robot(random.uniform(0.05, 0.2), {random.uniform(-0.6, 0.6), 0.1});
    case 2: {  // two pieces, a trailer behind
      const double width_m = random.uniform(0.05, 0.2);
      world::Body body = square_robot(0.3, width_m);
      body.shapes.push_back(world::make_disc({-0.3, 0}, 0.1, 0.2, 0.8).value());
      return body;
    }
    default:
      return round_robot(random.uniform(0.02, 0.3));
  }
}

world::Obstacle any_obstacle(RandomStream& random, double side_m) {
  const Pose2 X_WB{random.uniform(0, side_m), random.uniform(0, side_m), random.uniform(-4, 4)};
  switch (random.bits() % 4) {
    case 0:
      return standing(round_robot(random.uniform(0.05, 0.8)), X_WB);
    case 1:
      return standing(square_robot(0.05, random.uniform(1, 8)), X_WB);
    case 2: {  // a bridge over all of them
      world::Body bridge = square_robot(2, 1);
      bridge.shapes[0].z0_m = 1.5;
      bridge.shapes[0].z1_m = 2;
      return standing(std::move(bridge), X_WB);
    }
    default:
      return standing(square_robot(random.uniform(0.4, 1), random.uniform(0.4, 1)), X_WB);
  }
}

void fill(ContactArena& arena, std::uint32_t world) {
  RandomStream random(21, world, 1, 1);
  const double side_m = random.uniform(2, 14);
  const std::uint32_t obstacles = random.bits() % 12;
  for (std::uint32_t i = 0; i < obstacles; ++i) {
    arena.model.obstacles.push_back(any_obstacle(random, side_m));
  }
  const std::uint32_t robots = 5 + random.bits() % 60;
  for (std::uint32_t i = 0; i < robots; ++i) {
    // Some begin inside another, as a bad scenario has it; some are real.
    const Pose2 X_WR{random.uniform(0, side_m), random.uniform(0, side_m), random.uniform(-3, 3)};
    const std::uint32_t r = arena.add(any_robot(random), X_WR, random.bits() % 8 != 0);
    arena.movers[r].present = arena.movers[r].simulated || random.bits() % 3 != 0;
  }
  arena.begin();
}

/// Proposals of one step: some rest, some are slow, some fast, some spin; in a calm world all are
/// slow and hold their course.
void propose(ContactArena& arena, std::uint32_t world, std::uint32_t step, bool calm) {
  for (std::uint32_t r = 0; r < arena.movers.size(); ++r) {
    // Each robot keeps its course for a while, so that some press on what they meet.
    RandomStream random(22, r, world, calm ? 0 : step / 8);
    const std::uint32_t kind = calm ? 4 + random.bits() % 4 : random.bits() % 10;
    const double most_mps = calm ? 0.3 : 0.6;
    const double speed_mps = kind == 9 ? 3 : random.uniform(0, most_mps);
    const double spin_radps = kind == 8 ? random.uniform(-30, 30)
                              : calm    ? random.uniform(-0.1, 0.1)
                                        : random.uniform(-1, 1);
    arena.proposal[r] = kind < 2 ? Twist2{}
                                 : Twist2{random.uniform(-speed_mps, speed_mps),
                                          kind == 3 ? random.uniform(-0.3, 0.3) : 0, spin_radps};
    // Real robots walk on as somebody reports them.
    if (!arena.movers[r].simulated) arena.movers[r].X_WR.x += 0.01;
  }
  arena.refresh();
}

TEST(MotionPhase, GivesTheBitsOfTheResolverAlone) {
  std::size_t let_go = 0;
  std::size_t resolved = 0;
  std::size_t kept = 0;
  for (std::uint32_t world = 0; world < 300; ++world) {
    ContactArena fast;
    ContactArena plain;
    fill(fast, world);
    fill(plain, world);
    const bool calm = world % 2 == 1;
    for (std::uint32_t step = 0; step < 30; ++step) {
      propose(fast, world, step, calm);
      propose(plain, world, step, calm);
      fast.step(kStep_s);
      step_one_by_one(plain, *plain.resolver);
      expect_equal(fast, plain, static_cast<int>(world), static_cast<int>(step));
      if (HasFatalFailure()) return;
      resolved += fast.phase->resolved();
      let_go += fast.movers.size() - fast.phase->resolved();
      kept += fast.phase->kept_lists();
    }
  }
  // Each way was gone often enough to be compared.
  EXPECT_GT(let_go, 50'000U);
  EXPECT_GT(resolved, 20'000U);
  EXPECT_GT(kept, 2'000U);
}

/// Drives for `steps` and expects that nobody ever overlaps and that kept lists were used.
void expect_apart(ContactArena& arena, int steps) {
  std::size_t kept = 0;
  for (int step = 0; step < steps; ++step) {
    arena.step(kStep_s);
    kept += arena.phase->kept_lists();
    ASSERT_GE(arena.least_gap(), 0) << "step " << step;
  }
  EXPECT_GT(kept, 0U);
}

TEST(MotionPhase, TwoThatCreepTowardsEachOtherMeet) {
  ContactArena arena;
  arena.add(round_robot(0.15), {0, 0, 0});
  arena.add(round_robot(0.15), {1, 0, 0});
  arena.begin();
  arena.drive(0, {0.1, 0});
  arena.drive(1, {-0.1, 0});
  expect_apart(arena, 60);
  EXPECT_LT(arena.gap(0, 1), 1e-3);
}

TEST(MotionPhase, WhoStartsSuddenlyMeetsWhatStoodBeyondItsList) {
  ContactArena arena;
  // Nobody moves at first, and lists reach 0.05 m; then one makes steps of 0.1 m.
  arena.model.obstacles.push_back(standing(round_robot(0.05), {0.28, 0, 0}));
  arena.add(round_robot(0.15), {0, 0, 0});
  arena.begin();
  expect_apart(arena, 3);
  arena.drive(0, {1, 0});
  arena.step(kStep_s);
  EXPECT_EQ(arena.phase->resolved(), 1U);
  EXPECT_EQ(arena.limited[0], 1);
  EXPECT_GE(arena.least_gap(), 0);
}

/// The density of the swarm benchmark: a robot on 10 m^2, half as many boxes.
void fill_field(ContactArena& arena, std::uint32_t robots) {
  RandomStream random(23, 1, 1, 1);
  const double side_m = std::sqrt(10.0 * robots);
  for (std::uint32_t i = 0; i < robots / 2; ++i) {
    arena.model.obstacles.push_back(
        standing(square_robot(random.uniform(0.4, 1), random.uniform(0.4, 1)),
                 {random.uniform(0, side_m), random.uniform(0, side_m), random.uniform(-3, 3)}));
  }
  for (std::uint32_t r = 0; r < robots; ++r) {
    arena.add(round_robot(0.15),
              {random.uniform(0, side_m), random.uniform(0, side_m), random.uniform(-3, 3)});
  }
  arena.begin();
  for (Twist2& twist : arena.proposal) twist = {random.uniform(0, 0.4), 0, random.uniform(-1, 1)};
}

TEST(MotionPhase, LetsNearlyEverybodyGoWhereThereIsRoom) {
  ContactArena arena;
  fill_field(arena, 2000);
  arena.step(kStep_s);
  // Of 2000 placed blindly about 100 begin in a box and 60 beside another robot.
  EXPECT_LT(arena.phase->resolved(), 300U);
  EXPECT_GT(arena.phase->resolved(), 50U);
}

TEST(MotionPhase, IsTheSameForAnyNumberOfThreads) {
  constexpr std::uint32_t kRobots = 6000;  // enough for the pool to wake its threads
  ContactArena one(1);
  fill_field(one, kRobots);
  for (int step = 0; step < 10; ++step) one.step(kStep_s);
  for (const unsigned threads : {2U, 3U}) {
    ContactArena many(threads);
    fill_field(many, kRobots);
    for (int step = 0; step < 10; ++step) many.step(kStep_s);
    expect_equal(many, one, static_cast<int>(threads), 9);
  }
}

TEST(MotionPhase, WhoIsToldToStandStandsAndIsNotLimited) {
  ContactArena arena;
  arena.model.obstacles.push_back(standing(square_robot(1, 1), {0.6, 0, 0}));
  arena.add(round_robot(0.15), {0, 0, 0.3});  // in the box
  arena.begin();
  arena.limited[0] = 1;
  arena.velocity[0] = {1, 1, 1};
  arena.touch[0] = {true, {1, 0}};
  arena.step(kStep_s);
  EXPECT_EQ(arena.movers[0].X_WR, (Pose2{0, 0, 0.3}));
  EXPECT_EQ(arena.velocity[0], Twist2{});
  EXPECT_EQ(arena.limited[0], 0);
  EXPECT_FALSE(arena.touch[0].touching);
  EXPECT_TRUE(arena.notes.empty());
}

}  // namespace
}  // namespace rave::sim::testing
