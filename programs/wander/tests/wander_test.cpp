// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>

#include "programs/testing/room.hpp"

namespace rave {
namespace {

using testing::Rig;
using testing::Room;
using testing::Suite;

constexpr double kPeriod_s = testing::ProgramUnderTest::kPeriod_s;

Room furnished_room() {
  Room room;
  room.box(-4, -3, 4, 3)
      .box(-2.2, -1.2, -1.4, 0.4)
      .box(1.0, 0.8, 1.9, 1.6)
      .box(1.2, -2.0, 2.0, -1.3);
  return room;
}

struct Tour {
  double nearest_m = 1e9;  ///< Body to walls, smallest.
  double length_m = 0;
  int cells = 0;  ///< Of 0.5 m, visited.
};

Tour tour(Suite suite, std::uint64_t seed, double duration_s) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, suite);
  rig.pose.yaw_rad = 0.3 * static_cast<double>(seed);
  EXPECT_EQ(program.start(seed), "");
  const Room room = furnished_room();
  Tour result;
  std::map<std::pair<int, int>, int> visited;
  const int decisions = static_cast<int>(duration_s / kPeriod_s);
  for (int k = 0; k < decisions; ++k) {
    const SimTime now{k * 100'000'000LL};
    room.sense(rig, now);
    program.decide(now);
    for (int part = 0; part < 10; ++part) {
      testing::move(rig, kPeriod_s / 10);
      const double gap_m = room.distance_m({rig.pose.x_m, rig.pose.y_m}) - rig.radius_m;
      result.nearest_m = std::min(result.nearest_m, gap_m);
    }
    result.length_m += std::abs(rig.command().value[0]) * kPeriod_s;
    ++visited[{static_cast<int>(std::floor(rig.pose.x_m * 2)),
               static_cast<int>(std::floor(rig.pose.y_m * 2))}];
  }
  result.cells = static_cast<int>(visited.size());
  return result;
}

TEST(Wander, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  (void)program.add_robot();
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST(Wander, NeverHitsAnythingAndGetsAround) {
  for (const Suite suite : testing::kSuites) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Tour result = tour(suite, seed, 300);
      EXPECT_GT(result.nearest_m, 0.0) << "suite " << static_cast<int>(suite) << " seed " << seed;
      EXPECT_GT(result.length_m, 25.0) << "suite " << static_cast<int>(suite) << " seed " << seed;
      EXPECT_GT(result.cells, 25) << "suite " << static_cast<int>(suite) << " seed " << seed;
    }
  }
}

TEST(Wander, AnotherSeedIsAnotherWayAndTheSameSeedTheSame) {
  const Tour one = tour(Suite::kEightSonars, 1, 60);
  EXPECT_EQ(tour(Suite::kEightSonars, 1, 60).length_m, one.length_m);
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  for (int k = 0; k < 2; ++k) testing::add_suite(program.add_robot(), Suite::kEightSonars);
  ASSERT_EQ(program.start(1), "");
  const Room room = furnished_room();
  for (int k = 0; k < 600; ++k) {
    for (const auto& rig : program.rigs) room.sense(*rig, {k * 100'000'000LL});
    program.decide({k * 100'000'000LL});
    for (const auto& rig : program.rigs) testing::move(*rig, kPeriod_s);
  }
  // Two robots of one run draw different numbers.
  EXPECT_NE(program.rigs[0]->pose.x_m, program.rigs[1]->pose.x_m);
}

TEST(Wander, TurnsToTheFreerSideAndSlower) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  Rig& rig = program.add_robot();
  rig.add_ranges({0.6, 0.0, -0.6}, 0, 4.0);
  ASSERT_EQ(program.start(1), "");
  rig.sensors[0].give<float>({3.0F, 3.0F, 3.0F}, 0);
  program.decide({});
  EXPECT_EQ(rig.command(), velocity_command(0.3, 0));
  rig.sensors[0].give<float>({3.0F, 0.5F, 0.4F}, 0);
  program.decide({});
  EXPECT_EQ(rig.command().value[1], 1.0);
  EXPECT_LT(rig.command().value[0], 0.15);
  EXPECT_GT(rig.command().value[0], 0.0);
}

TEST(Wander, GoesOnTurningTheSameWayWhileItIsBlocked) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  Rig& rig = program.add_robot();
  rig.add_ranges({0.6, -0.6}, 0, 4.0);
  ASSERT_EQ(program.start(1), "");
  for (int k = 0; k < 100; ++k) {
    // The freer side changes all the time, as it does in a corner.
    const std::vector<float> ranges_m =
        k % 2 == 0 ? std::vector<float>{0.5F, 0.4F} : std::vector<float>{0.4F, 0.5F};
    rig.sensors[0].give(ranges_m, 0);
    program.decide({k * 100'000'000LL});
    ASSERT_EQ(rig.command().value[1], 1.0) << "decision " << k;
  }
}

TEST(Wander, StaysWithinItsArea) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  Rig& rig = program.add_robot();
  rig.params.set("stay_within_m", 3).set("centre_x_m", 10);
  rig.pose.x_m = 10;
  ASSERT_EQ(program.start(3), "");
  double farthest_m = 0;
  for (int k = 0; k < 3000; ++k) {
    program.decide({k * 100'000'000LL});
    testing::move(rig, kPeriod_s);
    farthest_m = std::max(farthest_m, std::sqrt(squared_norm({rig.pose.x_m - 10, rig.pose.y_m})));
  }
  EXPECT_GT(farthest_m, 3.0);
  EXPECT_LT(farthest_m, 3.8);
}

TEST(Wander, RefusesAStopDistanceBeyondTheAvoidDistance) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  program.add_robot().params.set("stop_m", 0.7).set("avoid_m", 0.6);
  EXPECT_EQ(program.start(1), "`stop_m` (0.7) must be less than `avoid_m` (0.6)");
}

TEST(Wander, TakesNewParametersAndRefusesBadOnes) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  Rig& rig = program.add_robot();
  ASSERT_EQ(program.start(1), "");
  program.decide({});
  EXPECT_EQ(rig.command().value[0], 0.3);
  rig.params.set("cruise_mps", 0.7);
  EXPECT_EQ(program.update(), "");
  program.decide({100'000'000});
  EXPECT_EQ(rig.command().value[0], 0.7);
  rig.params.set("cruise_mps", 0.1).set("stop_m", 0.9);
  EXPECT_EQ(program.update(), "`stop_m` (0.9) must be less than `avoid_m` (0.6)");
  program.decide({200'000'000});
  EXPECT_EQ(rig.command().value[0], 0.7);  // as before, in all
}

TEST(Wander, SaysWhatItsRobotLacks) {
  testing::ProgramUnderTest program(rave_register_plugin, "wander");
  program.add_robot().controllers = {{"arm", CommandKind::kJoint, 0}};
  EXPECT_NE(program.start(1).find("no controller that accepts `velocity`"), std::string::npos);
}

}  // namespace
}  // namespace rave
