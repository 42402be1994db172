// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/program_harness.hpp"

namespace rave {
namespace {

/// As documented: where a robot is and how fast it goes, world frame.
struct Said {
  double x_m = 0;
  double y_m = 0;
  double vx_mps = 0;
  double vy_mps = 0;
};

/// One robot at the origin that looks along x.
class FlockTest : public ::testing::Test {
 protected:
  void start(double separation, double alignment, double cohesion) {
    rig.params.set("separation", separation).set("alignment", alignment).set("cohesion", cohesion);
    ASSERT_EQ(program.start(1), "");
  }
  /// The turning rate that it commands at `t_s`.
  double turn(double t_s) {
    program.decide(SimTime{from_seconds(t_s).ns});
    EXPECT_EQ(rig.command().kind, CommandKind::kVelocity);
    return rig.command().value[1];
  }
  void hear(const Said& said, double t_s = 0, std::uint32_t from = 5) {
    radio.hear(from, SimTime{from_seconds(t_s).ns}, said);
  }

  testing::ProgramUnderTest program{rave_register_plugin, "flock"};
  testing::Rig& rig = program.add_robot();
  testing::RigRadio& radio = rig.add_radio("air");
};

TEST(Flock, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "flock");
  testing::Rig& rig = program.add_robot();
  rig.add_radio("air");
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST_F(FlockTest, AloneItGoesStraightAheadAndSaysWhereItIs) {
  start(1, 1, 1);
  rig.pose.x_m = 1;
  EXPECT_EQ(turn(0), 0);
  EXPECT_DOUBLE_EQ(rig.command().value[0], 0.25);
  rig.pose.x_m = 1.02;
  turn(0.1);
  ASSERT_EQ(radio.sent().size(), 1U);
  const Message message = *radio.sent().begin();
  EXPECT_EQ(message.to, Recipient::everyone());
  const auto said = message.as<Said>();
  ASSERT_TRUE(said);
  EXPECT_DOUBLE_EQ(said->x_m, 1.02);
  // Half of 0.2 m/s, as it was at rest before.
  EXPECT_NEAR(said->vx_mps, 0.1, 1e-12);
}

TEST_F(FlockTest, KeepsAwayFromThoseTooNear) {
  start(1, 0, 0);
  hear({0.2, 0.4, 0, 0});  // ahead to the left
  EXPECT_LT(turn(0), -0.1);
  hear({0.2, -0.4, 0, 0}, 0.1);
  EXPECT_GT(turn(0.1), 0.1);
  hear({5, 5, 0, 0}, 0.2);
  EXPECT_EQ(turn(0.2), 0);
}

TEST_F(FlockTest, GoesTheWayOfItsNeighbours) {
  start(0, 1, 0);
  hear({3, 0, 0, 0.25});
  EXPECT_GT(turn(0), 0.1);
  hear({3, 0, 0, -0.25}, 0.1);
  EXPECT_LT(turn(0.1), -0.1);
}

TEST_F(FlockTest, DrawsTowardsTheirMiddle) {
  start(0, 0, 1);
  hear({0, 3, 0, 0}, 0, 5);
  hear({0, -1, 0, 0}, 0, 6);
  EXPECT_GT(turn(0), 0.1);
}

TEST_F(FlockTest, MovesAWordOnAndForgetsTheSilent) {
  start(1, 0, 0);
  // Too far when it spoke, 0.3 m to the left 0.4 s later.
  hear({0, 2.3, 0, -5});
  EXPECT_EQ(turn(0), 0);
  EXPECT_LT(turn(0.4), -0.1);
  // After half a second of silence it is gone.
  EXPECT_EQ(turn(0.6), 0);
}

TEST_F(FlockTest, PassesOverMessagesOfOthers) {
  start(1, 1, 1);
  radio.hear(5, SimTime{}, 42);
  EXPECT_EQ(turn(0), 0);
}

TEST(Flock, NeedsACommunicator) {
  testing::ProgramUnderTest program(rave_register_plugin, "flock");
  program.add_robot();
  EXPECT_NE(program.start(1).find("has no communicator, which its program requires"),
            std::string::npos);
}

}  // namespace
}  // namespace rave
