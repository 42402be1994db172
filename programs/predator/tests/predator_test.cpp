// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "programs/testing/pursuit.hpp"

extern "C" void rave_register_prey(rave::RegistrySink* registry);

namespace rave {
namespace {

using testing::Rig;
using testing::Room;
using testing::Suite;

constexpr double kPeriod_s = testing::ProgramUnderTest::kPeriod_s;

struct Hunt {
  double captured_s = -1;  ///< -1: never.
  double last_m = 0;       ///< Distance at the end.
  double nearest_wall_m = 1e9;
  std::size_t lines = 0;
};

/// The two programs of this folder and the next, against each other.
Hunt hunt(const Room& room, double prey_mps, double limit_s, Suite suite = Suite::kSixteenSonars) {
  testing::ProgramUnderTest hunters(rave_register_plugin, "predator");
  testing::ProgramUnderTest hunted(rave_register_prey, "prey");
  Rig& predator = hunters.add_robot();
  Rig& prey = hunted.add_robot();
  prey.id = 1;
  predator.params.set("prey", 1).set("max_speed_mps", 0.5);
  prey.params.set("max_speed_mps", prey_mps).set("fear_m", 100);
  for (Rig* rig : {&predator, &prey}) {
    testing::add_suite(*rig, suite);
    rig->add(ReadingKind::kNeighbours, "neighbours").info.X_RS = {0.05, -0.02, 0.4};
  }
  prey.pose.x_m = 2.5;
  prey.pose.y_m = 0.5;
  EXPECT_EQ(hunters.start(1), "");
  EXPECT_EQ(hunted.start(1), "");
  Hunt result;
  for (int k = 0; k * kPeriod_s < limit_s; ++k) {
    const SimTime now{k * 100'000'000LL};
    for (auto [one, other] : {std::pair(&predator, &prey), std::pair(&prey, &predator)}) {
      room.sense(*one, now, {{{other->pose.x_m, other->pose.y_m}, other->radius_m}});
      testing::see(*one, *other, other->id, now);
    }
    hunters.decide(now);
    hunted.decide(now);
    testing::move(predator, kPeriod_s);
    testing::move(prey, kPeriod_s);
    result.nearest_wall_m =
        std::min(result.nearest_wall_m,
                 room.distance_m({predator.pose.x_m, predator.pose.y_m}) - predator.radius_m);
    if (result.captured_s < 0 && !predator.log.lines.empty()) result.captured_s = now.seconds();
  }
  result.lines = predator.log.lines.size();
  result.last_m = testing::distance_m(predator, prey);
  return result;
}

Room plain() {
  Room room;
  room.box(-500, -500, 500, 500);
  return room;
}

TEST(Predator, WhatItDoesNotSeeIsNoFreeSpace) {
  testing::ProgramUnderTest program(rave_register_plugin, "predator");
  testing::Rig& rig = program.add_robot();
  testing::RigSensor& eyes = rig.add(ReadingKind::kNeighbours, "neighbours");
  eyes.give(std::vector<NeighbourReading>{{9, 3, 0, 0, 0, 0}}, 0);
  testing::expect_stand_when_old_or_blind(testing::commands_by_age(program, [] {}));
}

TEST(Predator, CatchesASlowPreyInTheOpenAndSaysSoOnce) {
  const Hunt result = hunt(plain(), 0.3, 60);
  EXPECT_GT(result.captured_s, 0);
  // The lead is 2.55 - 0.6 m, closed at 0.2 m/s at best.
  EXPECT_GE(result.captured_s, 1.95 / 0.5);
  EXPECT_LT(result.captured_s, 30);
  EXPECT_EQ(result.lines, 1U);
}

TEST(Predator, DoesNotCatchAFasterPreyInTheOpen) {
  const Hunt result = hunt(plain(), 0.7, 120);
  EXPECT_EQ(result.captured_s, -1);
  EXPECT_GT(result.last_m, 10);
}

TEST(Predator, CatchesASlowPreyInAFurnishedRoomWithoutHittingIt) {
  Room room;
  room.box(-4, -3, 5, 3).box(1.0, -0.6, 1.6, 0.6).box(-2.0, 1.0, -1.2, 1.8);
  for (const Suite suite : {Suite::kEightSonars, Suite::kSixteenSonars, Suite::kLaser}) {
    const Hunt result = hunt(room, 0.25, 180, suite);
    EXPECT_GT(result.captured_s, 0) << "suite " << static_cast<int>(suite);
    EXPECT_GT(result.nearest_wall_m, 0.0) << "suite " << static_cast<int>(suite);
  }
}

/// One predator that is given readings by hand.
class PredatorAlone : public ::testing::Test {
 protected:
  void begin() {
    rig.add(ReadingKind::kNeighbours, "neighbours");
    ASSERT_EQ(program.start(1), "");
  }
  static NeighbourReading at(std::uint32_t robot, float range_m, float bearing_rad,
                             float vx_mps = 0, float vy_mps = 0) {
    return {robot, range_m, bearing_rad, vx_mps, vy_mps, 0};
  }
  double turn_for(const std::vector<NeighbourReading>& seen) {
    rig.sensors.back().give(seen, 0);
    program.decide({});
    return rig.command().value[1];
  }

  testing::ProgramUnderTest program{rave_register_plugin, "predator"};
  Rig& rig = program.add_robot();
};

TEST_F(PredatorAlone, AimsAtTheMeetingPoint) {
  begin();
  // Prey 4 m ahead crosses to the left at 0.3 m/s: with 0.5 m/s they meet where
  // sin(heading) = 0.3 / 0.5. Headings come in sectors of 5 degrees around exactly that.
  const double w_radps = turn_for({at(3, 4, 0, 0, 0.3F)});
  EXPECT_NEAR(w_radps, 3.0 * asin(0.6), 1e-6);
}

TEST_F(PredatorAlone, HuntsTheOneItIsToldOrTheNearest) {
  begin();
  EXPECT_GT(turn_for({at(3, 4, -0.5F), at(4, 2, 0.5F)}), 0.0);
  EXPECT_LT(turn_for({at(3, 2, -0.5F), at(4, 4, 0.5F)}), 0.0);
  testing::ProgramUnderTest told(rave_register_plugin, "predator");
  Rig& other = told.add_robot();
  other.params.set("prey", 3);
  other.add(ReadingKind::kNeighbours, "neighbours");
  ASSERT_EQ(told.start(1), "");
  other.sensors.back().give<NeighbourReading>({at(3, 4, -0.5F), at(4, 2, 0.5F)}, 0);
  told.decide({});
  EXPECT_LT(other.command().value[1], 0.0);
}

TEST_F(PredatorAlone, AvoidsObstaclesButNotThePrey) {
  rig.add_ranges({-0.1, 0.0, 0.1}, 0, 4.0);
  begin();
  rig.sensors.front().give<float>({0.85F, 0.85F, 0.85F}, 0);
  EXPECT_NEAR(turn_for({at(3, 0.9F, 0)}), 0.0, 1e-9) << "that is the prey";
  EXPECT_GT(std::abs(turn_for({at(3, 3.0F, 0)})), 0.5) << "that is something before it";
}

TEST_F(PredatorAlone, LooksAroundWhenItSeesNobody) {
  begin();
  EXPECT_GT(turn_for({}), 0.0);
  EXPECT_EQ(rig.command().value[0], 0.0);
}

TEST(Predator, NeedsASensorForNeighbours) {
  testing::ProgramUnderTest program(rave_register_plugin, "predator");
  program.add_robot();
  EXPECT_NE(program.start(1).find("sensor of kind `neighbours`"), std::string::npos);
}

}  // namespace
}  // namespace rave
