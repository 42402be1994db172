// SPDX-License-Identifier: Apache-2.0
#include "hand_over_drivers.hpp"
#include "input_parts.hpp"

namespace rave::sim::testing {
namespace {

EngineSpec two_sets() {
  EngineSpec spec;
  add_robot(spec, simulated_type());
  add_drivers(spec, simulated_type());
  add_robot(spec, simulated_type(), {0, 2, 0});
  return spec;
}

std::string why(const Status& status) { return status ? "" : status.error().message; }

TEST(HandOvers, AStandingRobotGetsItsOtherDrivers) {
  InputParts parts(two_sets());
  ASSERT_TRUE(parts.hand_overs.ask(1, kRobot, DriverSet::kTwin, Author::kHand));
  EXPECT_TRUE(parts.hand_overs.is_under_way(kRobot));
  EXPECT_EQ(parts.log.by_hand(), 1U);
  parts.hand_overs.advance(1);
  EXPECT_TRUE(parts.guards[0].holds().held) << "it is made to stand";
  EXPECT_TRUE(parts.calls.empty()) << "the command that makes it stand has to reach it first";
  parts.hand_overs.advance(2);
  EXPECT_EQ(parts.calls, (std::vector<std::string>{"halt", "changed", "guards"}));
  EXPECT_FALSE(parts.guards[0].holds().held);
  const HandOverState* const state = parts.hand_overs.state(kRobot);
  ASSERT_NE(state, nullptr);
  EXPECT_EQ(state->active, DriverSet::kTwin);
  EXPECT_EQ(state->made, 1U);
  EXPECT_EQ(parts.spec.robots[0].type, 1U);
  const auto told = parts.told();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].kind, EventKind::kHandedOver);
  EXPECT_EQ(told[0].step, 2U);
}

TEST(HandOvers, ARobotThatDoesNotStandKeepsItsDrivers) {
  InputParts parts(two_sets());
  ASSERT_TRUE(parts.hand_overs.ask(0, kRobot, DriverSet::kTwin, Author::kRun));
  parts.truth.velocity[0] = {0.5, 0, 0};
  for (std::uint64_t step = 0; step <= 1000; ++step) parts.hand_overs.advance(step);
  EXPECT_TRUE(parts.hand_overs.is_under_way(kRobot)) << "it has 10 s";
  parts.hand_overs.advance(1001);
  EXPECT_FALSE(parts.guards[0].holds().held);
  EXPECT_EQ(parts.hand_overs.state(kRobot)->refused, 1U);
  const auto told = parts.told();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].kind, EventKind::kHandOverRefused);
  EXPECT_NE(told[0].text.find("it did not come to rest within 10 s"), std::string::npos);
  EXPECT_TRUE(parts.calls.empty());
}

TEST(HandOvers, TimeThatIsSkippedIsNoneInWhichARobotMoved) {
  InputParts parts(two_sets());
  ASSERT_TRUE(parts.hand_overs.ask(0, kRobot, DriverSet::kTwin, Author::kRun));
  parts.truth.velocity[0] = {0.5, 0, 0};
  parts.hand_overs.advance(0);
  parts.hand_overs.skip_to(5000);
  parts.hand_overs.advance(5001);
  EXPECT_TRUE(parts.hand_overs.is_under_way(kRobot));
}

TEST(HandOvers, WhatCannotBeAskedIsRefusedAtOnce) {
  InputParts parts(two_sets());
  EXPECT_EQ(why(parts.hand_overs.ask(0, RobotId(1), DriverSet::kTwin, Author::kHand)),
            "robot `r1` has one set of drivers; `twin:` in the scenario names another");
  EXPECT_EQ(why(parts.hand_overs.ask(0, kRobot, DriverSet::kFirst, Author::kHand)),
            "robot `r0` already has its simulated drivers");
  ASSERT_TRUE(parts.hand_overs.ask(0, kRobot, DriverSet::kTwin, Author::kHand));
  EXPECT_EQ(why(parts.hand_overs.ask(0, kRobot, DriverSet::kTwin, Author::kHand)),
            "robot `r0` is already being handed over");
  EXPECT_EQ(parts.log.by_hand(), 1U) << "of what was refused nothing counts";
}

TEST(HandOvers, ThoseOfTheScenarioBeginInTheirStep) {
  EngineSpec spec = two_sets();
  spec.hand_overs = {{5, kRobot, DriverSet::kTwin}, {6, RobotId(1), DriverSet::kTwin}};
  InputParts parts(std::move(spec));
  parts.hand_overs.advance(4);
  EXPECT_FALSE(parts.hand_overs.is_under_way(kRobot));
  parts.hand_overs.advance(5);
  EXPECT_TRUE(parts.hand_overs.is_under_way(kRobot));
  EXPECT_EQ(parts.log.by_hand(), 0U);
  parts.hand_overs.advance(6);
  const auto told = parts.told();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].kind, EventKind::kHandOverRefused) << "the other robot has one set";
  EXPECT_EQ(told[1].kind, EventKind::kHandedOver);
}

TEST(HandOvers, RestoreGivesTheFirstDriversBack) {
  InputParts parts(two_sets());
  ASSERT_TRUE(parts.hand_overs.ask(0, kRobot, DriverSet::kTwin, Author::kRun));
  parts.hand_overs.advance(0);
  parts.hand_overs.advance(1);
  ASSERT_EQ(parts.spec.robots[0].type, 1U);
  ASSERT_TRUE(parts.hand_overs.restore());
  EXPECT_EQ(parts.spec.robots[0].type, 0U);
  EXPECT_EQ(parts.calls.back(), "restored");
  EXPECT_EQ(parts.hand_overs.state(kRobot)->made, 0U);
}

}  // namespace
}  // namespace rave::sim::testing
