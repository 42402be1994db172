// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/room.hpp"

namespace rave {
namespace {

using testing::Rig;
using testing::Room;
using testing::Suite;

constexpr double kPeriod_s = testing::ProgramUnderTest::kPeriod_s;

struct Trip {
  double nearest_m = 1e9;  ///< Body to walls, smallest.
  double arrived_s = -1;   ///< -1: not within the time.
};

/// Lets one started robot drive until its program says `line` or time is over.
Trip trip(testing::ProgramUnderTest& program, const Room& room, double limit_s,
          std::string_view line) {
  Rig& rig = *program.rigs.front();
  Trip result;
  for (int k = 0; k * kPeriod_s < limit_s; ++k) {
    room.sense(rig, {k * 100'000'000LL});
    program.decide({k * 100'000'000LL});
    for (const std::string& text : rig.log.lines) {
      if (text.find(line) == std::string::npos) continue;
      result.arrived_s = k * kPeriod_s;
      return result;
    }
    for (int part = 0; part < 10; ++part) {
      testing::move(rig, kPeriod_s / 10);
      const double gap_m = room.distance_m({rig.pose.x_m, rig.pose.y_m}) - rig.radius_m;
      result.nearest_m = std::min(result.nearest_m, gap_m);
    }
  }
  return result;
}

/// From the origin to (gx, gy).
Trip go(Suite suite, const Room& room, double gx_m, double gy_m, double limit_s) {
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, suite);
  rig.params.set("goal_x_m", gx_m).set("goal_y_m", gy_m);
  EXPECT_EQ(program.start(1), "");
  Trip result = trip(program, room, limit_s, "goal 1 of 1 reached");
  const Vec2 off{rig.pose.x_m - gx_m, rig.pose.y_m - gy_m};
  if (result.arrived_s >= 0) {
    EXPECT_LE(std::sqrt(squared_norm(off)), 0.15);
    EXPECT_EQ(rig.command(), velocity_command(0, 0));
  }
  return result;
}

TEST(GoToGoal, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  testing::Rig& rig = program.add_robot();
  rig.params.set("goal_x_m", 5).set("goal_y_m", 0);
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST(GoToGoal, ReachesAGoalInTheOpenInAboutTheTimeOfAStraightLine) {
  Room room;
  room.box(-10, -10, 10, 10);
  const Trip result = go(Suite::kLaser, room, 3, 4, 60);
  EXPECT_GE(result.arrived_s, 4.8 / 0.4);
  EXPECT_LT(result.arrived_s, 20);
}

/// A car from the origin to a point; it never asks for a curve that a car cannot drive.
Trip drive_car(const Room& room, Vec2 goal_W, double limit_s) {
  constexpr double kRadius_m = 0.6;
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, Suite::kLaser);
  rig.params.set("goal_x_m", goal_W.x)
      .set("goal_y_m", goal_W.y)
      .set("min_turn_radius_m", kRadius_m);
  EXPECT_EQ(program.start(1), "");
  Trip result;
  for (int k = 0; k * kPeriod_s < limit_s; ++k) {
    room.sense(rig, {k * 100'000'000LL});
    program.decide({k * 100'000'000LL});
    const Command& told = rig.command();
    EXPECT_LE(std::abs(told.value[1]) * kRadius_m, std::abs(told.value[0]) + 1e-9) << k;
    if (!rig.log.lines.empty()) {
      result.arrived_s = k * kPeriod_s;
      return result;
    }
    testing::move(rig, kPeriod_s);
    const double gap_m = room.distance_m({rig.pose.x_m, rig.pose.y_m}) - rig.radius_m;
    result.nearest_m = std::min(result.nearest_m, gap_m);
  }
  return result;
}

TEST(GoToGoal, ACarReachesGoalsAllAround) {
  Room room;
  room.box(-10, -10, 10, 10);
  for (int degrees = 0; degrees < 360; degrees += 30) {
    for (const double distance_m : {0.4, 3.0}) {
      const double bearing_rad = deg_to_rad(degrees);
      const Vec2 goal_W{distance_m * cos(bearing_rad), distance_m * sin(bearing_rad)};
      EXPECT_GT(drive_car(room, goal_W, 90).arrived_s, 0) << degrees << " deg, " << distance_m;
    }
  }
}

TEST(GoToGoal, ACarGoesAroundABox) {
  Room room;
  room.box(-5, -5, 9, 5).box(2, -0.8, 3, 0.6);
  const Trip result = drive_car(room, {6, 0}, 120);
  EXPECT_GT(result.arrived_s, 0);
  EXPECT_GT(result.nearest_m, 0);
}

TEST(GoToGoal, GoesAroundBoxes) {
  Room room;
  room.box(-3, -4, 9, 4).box(1.5, -0.6, 2.3, 0.7).box(3.6, -1.8, 4.2, 0.1).box(3.6, 0.9, 4.2, 2.0);
  for (const Suite suite : testing::kSuites) {
    const Trip result = go(suite, room, 6.5, 0.2, 120);
    EXPECT_GT(result.arrived_s, 0) << "suite " << static_cast<int>(suite);
    EXPECT_GT(result.nearest_m, 0.0) << "suite " << static_cast<int>(suite);
  }
}

TEST(GoToGoal, GetsOutOfAConcaveTrap) {
  Room room;
  room.box(-4, -5, 9, 5);
  // A bay of 2 m by 3 m, open toward the start, between start and goal.
  room.wall({1.0, -1.5}, {3.0, -1.5}).wall({3.0, -1.5}, {3.0, 1.5}).wall({3.0, 1.5}, {1.0, 1.5});
  for (const Suite suite : testing::kSuites) {
    for (const double goal_y_m : {-1.0, 0.0, 0.7}) {
      const Trip result = go(suite, room, 6, goal_y_m, 300);
      EXPECT_GT(result.arrived_s, 0) << "suite " << static_cast<int>(suite) << " y " << goal_y_m;
      EXPECT_GT(result.nearest_m, 0.0) << "suite " << static_cast<int>(suite) << " y " << goal_y_m;
    }
  }
}

TEST(GoToGoal, SaysWhenItHasGoneRoundWithoutFindingAWay) {
  Room room;
  room.box(-4, -5, 9, 5).box(3, -1, 5, 1);  // The goal lies in the box.
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, Suite::kSixteenSonars);
  rig.params.set("goal_x_m", 4.0).set("goal_y_m", 0.0);
  ASSERT_EQ(program.start(1), "");
  const Trip result = trip(program, room, 300, "no path to goal 1 found by");
  EXPECT_GT(result.arrived_s, 0);
  EXPECT_GT(result.nearest_m, 0.0);
}

TEST(GoToGoal, TakesGoalsInOrderAndStaysAtTheLast) {
  Room room;
  room.box(-10, -10, 10, 10);
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, Suite::kEightSonars);
  rig.params.set("goals_m", {2, 0, 2, 2, -1, 1});
  ASSERT_EQ(program.start(1), "");
  trip(program, room, 120, "never said");
  ASSERT_EQ(rig.log.lines.size(), 3U);
  EXPECT_NE(rig.log.lines[0].find("goal 1 of 3 reached"), std::string::npos);
  EXPECT_NE(rig.log.lines[2].find("goal 3 of 3 reached"), std::string::npos);
  EXPECT_NEAR(rig.pose.x_m, -1, 0.15);
  EXPECT_NEAR(rig.pose.y_m, 1, 0.15);
}

TEST(GoToGoal, StandsStillWhileItDoesNotKnowWhereItIs) {
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  Rig& rig = program.add_robot();
  rig.params.set("goal_x_m", 4.0);
  ASSERT_EQ(program.start(1), "");
  program.decide({});
  EXPECT_GT(rig.command().value[0], 0.0);
  rig.pose.x_m = std::numeric_limits<double>::quiet_NaN();
  program.decide({100'000'000});
  EXPECT_EQ(rig.command(), velocity_command(0, 0));
}

TEST(GoToGoal, RefusesHalfAGoal) {
  testing::ProgramUnderTest program(rave_register_plugin, "go_to_goal");
  program.add_robot().params.set("goals_m", {1, 2, 3});
  EXPECT_EQ(program.start(1), "`goals_m` must hold x, y, x, y, ...; it has 3 numbers");
}

}  // namespace
}  // namespace rave
