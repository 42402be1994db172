// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "programs/testing/program_harness.hpp"

namespace rave {
namespace {

using testing::ProgramUnderTest;
using testing::Rig;

constexpr float kFree = std::numeric_limits<float>::infinity();

/// Bearings of `count` rays from -fov/2 to fov/2.
std::vector<double> bearings(int count, double fov_deg) {
  std::vector<double> found;
  for (int i = 0; i < count; ++i) {
    found.push_back(deg_to_rad(fov_deg * (static_cast<double>(i) / (count - 1) - 0.5)));
  }
  return found;
}

/// One robot with nine rays at -80, -60, ..., 80 degrees; 0 to 8 from right to left.
class CruiseTest : public ::testing::Test {
 protected:
  void start(std::uint64_t seed = 1) {
    rig_.add_ranges(bearings(9, 160), 0, 8.0);
    ASSERT_EQ(program_.start(seed), "");
  }
  /// Decides on these readings; the command.
  Command decide(const std::vector<float>& ranges_m) {
    rig_.sensors[0].give<float>(ranges_m, 0);
    program_.decide({k_++ * 100'000'000LL});
    return rig_.command();
  }
  static std::vector<float> all_free() { return std::vector<float>(9, kFree); }
  static std::vector<float> with(std::size_t ray, float range_m) {
    std::vector<float> ranges_m = all_free();
    ranges_m[ray] = range_m;
    return ranges_m;
  }

  ProgramUnderTest program_{rave_register_plugin, "cruise"};
  Rig& rig_ = program_.add_robot();
  std::int64_t k_ = 0;
};

TEST(Cruise, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "cruise");
  (void)program.add_robot();
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST_F(CruiseTest, DrivesStraightOnWhileNothingIsNearAhead) {
  start();
  program_.decide({});  // before the first sample
  EXPECT_EQ(rig_.command(), velocity_command(0.4, 0));
  EXPECT_EQ(decide(all_free()), velocity_command(0.4, 0));
  EXPECT_EQ(decide(with(4, 0.75F)), velocity_command(0.4, 0));
  // Near, but beyond 50 degrees to either side.
  for (const std::size_t ray : {0U, 1U, 7U, 8U}) {
    EXPECT_EQ(decide(with(ray, 0.1F)), velocity_command(0.4, 0)) << "ray " << ray;
  }
}

TEST_F(CruiseTest, TurnsToTheFreerSideAndCreeps) {
  for (const bool left : {false, true}) {
    ProgramUnderTest program(rave_register_plugin, "cruise");
    Rig& rig = program.add_robot();
    rig.add_ranges(bearings(9, 160), 0, 8.0);
    ASSERT_EQ(program.start(1), "");
    rig.sensors[0].give<float>(with(left ? 3 : 5, 0.5F), 0);
    program.decide({});
    EXPECT_EQ(rig.command(), velocity_command(0.05, left ? 0.8 : -0.8));
  }
}

TEST_F(CruiseTest, StandsWhileItTurnsFromWhatIsVeryNear) {
  start();
  EXPECT_EQ(decide(with(3, 0.34F)), velocity_command(0, 0.8));
  EXPECT_EQ(decide(with(3, 0.36F)), velocity_command(0.05, 0.8));
  EXPECT_EQ(decide(all_free()), velocity_command(0.05, 0.8));
}

TEST_F(CruiseTest, ATurnLastsFiveToFourteenDecisions) {
  start();
  std::set<int> lengths;
  for (int turn = 0; turn < 300; ++turn) {
    int length = 0;
    for (Command command = decide(with(3, 0.5F)); command.value[1] != 0; ++length) {
      command = decide(all_free());
    }
    lengths.insert(length);
  }
  EXPECT_EQ(lengths, (std::set<int>{5, 6, 7, 8, 9, 10, 11, 12, 13, 14}));
}

TEST_F(CruiseTest, LooksAgainAfterATurn) {
  rig_.params.set("turn_decisions_max", 5);
  start();
  for (int k = 0; k < 5; ++k) EXPECT_EQ(decide(with(3, 0.5F)).value[1], 0.8) << k;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(decide(with(5, 0.5F)).value[1], -0.8) << k;
  EXPECT_EQ(decide(all_free()).value[1], 0);
}

TEST_F(CruiseTest, ChanceDecidesIfBothSidesAreTheSame) {
  rig_.params.set("turn_decisions_min", 1).set("turn_decisions_max", 1);
  start();
  std::multiset<double> turns;
  for (int k = 0; k < 1000; ++k) turns.insert(decide(with(4, 0.5F)).value[1]);
  EXPECT_EQ(turns.count(0.8) + turns.count(-0.8), 1000U);
  EXPECT_GT(turns.count(0.8), 400U);
  EXPECT_GT(turns.count(-0.8), 400U);
}

TEST_F(CruiseTest, WhatIsNotANumberDoesNotCountAndTooNearToMeasureDoes) {
  start();
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(decide(with(0, unknown)), velocity_command(0.4, 0)) << "it does not look there";
  EXPECT_EQ(decide(with(3, -kFree)), velocity_command(0, 0.8));
}

TEST(Cruise, FindsTheNearestOfManyRays) {
  ProgramUnderTest program(rave_register_plugin, "cruise");
  Rig& rig = program.add_robot();
  rig.params.set("turn_decisions_min", 1).set("turn_decisions_max", 1);
  rig.add_ranges(bearings(180, 180), 0, 8.0);
  ASSERT_EQ(program.start(1), "");
  for (std::size_t ray = 0; ray < 180; ++ray) {
    std::vector<float> ranges_m(180, 2.0F);
    ranges_m[ray] = 0.5F;
    rig.sensors[0].give(ranges_m, 0);
    program.decide({});
    const double bearing_deg = 180.0 * (static_cast<double>(ray) / 179 - 0.5);
    const double turn = std::abs(bearing_deg) > 50 ? 0 : (bearing_deg > 0 ? -0.8 : 0.8);
    ASSERT_EQ(rig.command().value[1], turn) << "ray " << ray;
  }
}

TEST(Cruise, ALaserThatLooksSidewaysIsTurnedIntoTheRobotsFrame) {
  ProgramUnderTest program(rave_register_plugin, "cruise");
  Rig& rig = program.add_robot();
  // -80 to 80 degrees about its own axis, which points 60 degrees to the left.
  rig.add_ranges(bearings(9, 160), 0, 8.0).info.X_RS.yaw = deg_to_rad(60);
  ASSERT_EQ(program.start(1), "");
  rig.sensors[0].give(std::vector<float>{kFree, kFree, 0.5F, kFree, 0.5F, 0.1F, 0.1F, 0.1F, 0.1F},
                      0);
  program.decide({});  // 0.5 m at 20 degrees to the left; 0.1 m from 80 degrees on
  EXPECT_EQ(rig.command(), velocity_command(0.05, -0.8));
}

TEST(Cruise, SaysWhatItsRobotLacks) {
  const auto problem = [](const std::vector<double>& bearings_rad) {
    ProgramUnderTest program(rave_register_plugin, "cruise");
    Rig& rig = program.add_robot();
    if (!bearings_rad.empty()) rig.add_ranges(bearings_rad, 0, 8.0);
    return program.start(1);
  };
  EXPECT_NE(problem({}).find("has no sensor of kind `ranges`, which its program requires"),
            std::string::npos)
      << problem({});
  EXPECT_EQ(problem({2, 3}), "no ray of sensor `ranges` points within 50 deg of the front");
  const std::string order =
      "the rays of sensor `ranges` within 50 deg of the front are not one row from right to left";
  EXPECT_EQ(problem({0.3, 0, -0.3}), order);
  EXPECT_EQ(problem({-0.3, 2, 0.3}), order);
}

TEST_F(CruiseTest, TakesNewParametersAndRefusesBadOnes) {
  start();
  rig_.params.set("cruise_mps", 0.2).set("front_deg", 20);
  EXPECT_EQ(program_.update(), "");
  EXPECT_EQ(decide(with(2, 0.5F)), velocity_command(0.2, 0));
  rig_.params.set("cruise_mps", 0.1).set("turn_decisions_max", 4);
  EXPECT_EQ(program_.update(),
            "`turn_decisions_max` (4) must be at least `turn_decisions_min` (5)");
  EXPECT_EQ(decide(all_free()), velocity_command(0.2, 0));  // as before, in all
}

}  // namespace
}  // namespace rave
