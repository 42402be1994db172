// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/pursuit.hpp"

namespace rave {
namespace {

using testing::Rig;
using testing::Room;
using testing::Suite;

constexpr double kPeriod_s = testing::ProgramUnderTest::kPeriod_s;

class PreyTest : public ::testing::Test {
 protected:
  void begin() {
    rig.add(ReadingKind::kNeighbours, "neighbours");
    rig.params.set("max_speed_mps", 0.6).set("calm_speed_mps", 0.2).set("fear_m", 3);
    ASSERT_EQ(program.start(5), "");
  }
  const Command& answer(const std::vector<NeighbourReading>& seen) {
    rig.sensors.back().give(seen, 0);
    program.decide({});
    return rig.command();
  }
  static NeighbourReading at(float range_m, float bearing_rad) {
    return {9, range_m, bearing_rad, 0, 0, 0};
  }

  testing::ProgramUnderTest program{rave_register_plugin, "prey"};
  Rig& rig = program.add_robot();
};

TEST(Prey, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "prey");
  testing::Rig& rig = program.add_robot();
  testing::RigSensor& eyes = rig.add(ReadingKind::kNeighbours, "neighbours");
  eyes.give(std::vector<NeighbourReading>{}, 0);
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST_F(PreyTest, FleesAtItsNewSpeed) {
  begin();
  rig.params.set("max_speed_mps", 0.25);
  EXPECT_EQ(program.update(), "");
  EXPECT_NEAR(answer({at(2, static_cast<float>(kPi))}).value[0], 0.25, 1e-6);
}

TEST_F(PreyTest, FleesStraightAwayAtFullSpeed) {
  begin();
  const Command out = answer({at(2, static_cast<float>(kPi))});
  EXPECT_NEAR(out.value[0], 0.6, 1e-6);
  EXPECT_NEAR(out.value[1], 0.0, 1e-5);
}

TEST_F(PreyTest, TheNearerNeighbourCountsMore) {
  begin();
  // One at the left near, one at the right far: it turns right, away from the near one.
  EXPECT_LT(answer({at(1, 1.6F), at(2, -1.6F)}).value[1], -0.5);
  EXPECT_GT(answer({at(2, 1.6F), at(1, -1.6F)}).value[1], 0.5);
}

TEST_F(PreyTest, StrollsWhenNobodyIsNear) {
  begin();
  double turned_rad = 0;
  for (int k = 0; k < 100; ++k) {
    const Command out = answer({at(5, 0)});
    EXPECT_LE(out.value[0], 0.2);
    EXPECT_GT(out.value[0], 0.15);
    EXPECT_LE(std::abs(out.value[1]), 0.6 + 1e-9);
    turned_rad += std::abs(out.value[1]);
  }
  EXPECT_GT(turned_rad, 1.0);
}

TEST(Prey, FleesAlongWallsWithoutHittingThem) {
  for (const Suite suite : testing::kSuites) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      testing::ProgramUnderTest one(rave_register_plugin, "prey");
      Rig& prey = one.add_robot();
      testing::add_suite(prey, suite);
      prey.add(ReadingKind::kNeighbours, "neighbours");
      prey.params.set("max_speed_mps", 0.4);
      ASSERT_EQ(one.start(seed), "");
      Room room;
      room.box(-3, -2.5, 3, 2.5).box(-1.5, 0.8, -0.7, 1.4);
      Rig threat{DriverInfo{}};
      threat.commands.resize(1);
      double nearest_m = 1e9;
      double length_m = 0;
      for (int k = 0; k < 1200; ++k) {
        // Somebody circles in the room, a lap a minute.
        const double lap_rad = 2.0 * kPi * k / 600.0;
        threat.pose.x_m = 1.5 * cos(lap_rad);
        threat.pose.y_m = 1.5 * sin(lap_rad);
        room.sense(prey, {k * 100'000'000LL});
        testing::see(prey, threat, 9, {k * 100'000'000LL});
        one.decide({k * 100'000'000LL});
        testing::move(prey, kPeriod_s);
        length_m += prey.command().value[0] * kPeriod_s;
        const double gap_m = room.distance_m({prey.pose.x_m, prey.pose.y_m}) - prey.radius_m;
        nearest_m = std::min(nearest_m, gap_m);
      }
      EXPECT_GT(nearest_m, 0.0) << "suite " << static_cast<int>(suite) << " seed " << seed;
      EXPECT_GT(length_m, 4.0) << "suite " << static_cast<int>(suite) << " seed " << seed;
    }
  }
}

}  // namespace
}  // namespace rave
