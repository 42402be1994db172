// SPDX-License-Identifier: Apache-2.0
#include "input_parts.hpp"
#include "rave/sim_testing/order_programs.hpp"

namespace rave::sim::testing {
namespace {

struct OneRobot : InputParts {
  explicit OneRobot(RobotType type) : InputParts(with(std::move(type))) {}
  static EngineSpec with(RobotType type) {
    EngineSpec spec;
    add_robot(spec, std::move(type));
    return spec;
  }
  ControllerSlots& controller(std::size_t index) { return group().controllers[index]; }
  RobotGroup& group() { return roster.group_of(kRobot); }
  Status take(std::uint64_t step, const WorldInput& input) {
    return orders.take(step, input, guards[0].holds(), false);
  }
};

TEST(OrderBook, AVelocityTakesThePlaceOfTheProgramUntilItIsCancelled) {
  OneRobot robot(driver_type());
  EXPECT_TRUE(robot.orders.empty());
  ASSERT_TRUE(robot.take(3, drive(kRobot, 0.5, 0.1)));
  EXPECT_EQ(robot.orders.under_way(kRobot), "drive");
  EXPECT_EQ(robot.group().program.items[0].driven, 1);
  robot.controller(0).last[0] = velocity_command(0.2, 0);  // what the program says
  robot.orders.steer(robot.moment(3));
  EXPECT_EQ(robot.controller(0).last[0], velocity_command(0.5, 0.1));
  EXPECT_EQ(robot.controller(0).last_step[0], 3);
  robot.orders.cancel(4, cancel(RobotId()));
  EXPECT_EQ(robot.orders.under_way(kRobot), "");
  EXPECT_EQ(robot.controller(0).last[0], Command{}) << "it stands until the program speaks";
  EXPECT_EQ(robot.controller(0).last_step[0], -1);
  EXPECT_EQ(robot.group().program.items[0].driven, 0);
  const auto told = robot.told();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].step, 3U);
  EXPECT_EQ(told[1].step, 4U);
  EXPECT_EQ(robot.log.by_hand(), 2U);
}

TEST(OrderBook, AStickThatGoesOnCountsButIsToldOnce) {
  OneRobot robot(driver_type());
  ASSERT_TRUE(robot.take(0, drive(kRobot, 0.5, 0)));
  const RunHash before = robot.hash;
  ASSERT_TRUE(robot.take(1, drive(kRobot, 0.4, 0)));
  EXPECT_NE(robot.hash.value(), before.value());
  EXPECT_EQ(robot.log.by_hand(), 2U);
  EXPECT_EQ(robot.told().size(), 1U);
}

TEST(OrderBook, ARobotThatIsHeldTakesNoMotion) {
  OneRobot robot(driver_type());
  const auto why = [&](const GuardHolds& holds, bool handed_over) {
    const Status status = robot.orders.take(0, drive(kRobot, 0.5, 0), holds, handed_over);
    return status ? std::string() : status.error().message;
  };
  EXPECT_EQ(why({.stopped = true}, false),
            "robot `r0`, drive: it is stopped; a stop holds until it is released");
  EXPECT_EQ(why({.armed = false}, false), "robot `r0`, drive: it waits to be armed");
  EXPECT_EQ(why({}, true), "robot `r0`, drive: it is being handed over");
  EXPECT_TRUE(robot.orders.empty());
  EXPECT_TRUE(robot.told().empty());
  EXPECT_EQ(why({}, false), "");
}

TEST(OrderBook, WhatTheRobotDoesNotTakeIsRefused) {
  OneRobot robot(driver_type());
  const Status text = robot.take(0, words(kRobot, "hello"));
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message, "robot `r0`, text: its program takes no texts");
  const Status there = robot.take(0, goal(kRobot, {1, 0}));
  ASSERT_FALSE(there);
  EXPECT_EQ(there.error().message,
            "robot `r0`, goal: neither its program nor one of its controllers takes goals");
}

TEST(OrderBook, AnOrderWaitsForTheNextDecision) {
  OneRobot robot(listener_type());  // decides in every other step
  ASSERT_TRUE(robot.take(1, words(kRobot, "hello")));
  DecideItem& item = robot.group().program.items[0];
  robot.orders.show(1);
  EXPECT_EQ(item.order_count, 0U) << "it does not decide in step 1";
  robot.orders.hide();
  robot.orders.show(2);
  ASSERT_EQ(item.order_count, 1U);
  EXPECT_EQ(std::string(item.orders[0].text, item.orders[0].text_size), "hello");
  robot.orders.hide();
  EXPECT_EQ(item.order_count, 0U);
  robot.orders.show(4);
  EXPECT_EQ(item.order_count, 0U) << "it is shown once";
}

TEST(OrderBook, AGoalOfAControllerIsReachedOnce) {
  OneRobot robot(goal_type());
  ASSERT_TRUE(robot.take(0, goal(kRobot, {1, 0})));
  robot.reported[0].known = true;
  robot.reported[0].pose.x_m = 0.5;
  robot.orders.steer(robot.moment(0));
  EXPECT_TRUE(robot.events.empty());
  robot.reported[0].pose.x_m = 0.95;
  robot.orders.steer(robot.moment(1));
  robot.orders.steer(robot.moment(2));
  ASSERT_EQ(robot.events.size(), 1U);
  EXPECT_EQ(robot.events[0].step, 1U);
  EXPECT_EQ(robot.events[0].text, "goal 1.00, 0.00: reached");
  EXPECT_EQ(robot.orders.under_way(kRobot), "goal 1.00, 0.00, reached");
}

TEST(OrderBook, ARunThatBeginsKnowsNoOrders) {
  OneRobot robot(driver_type());
  ASSERT_TRUE(robot.take(0, drive(kRobot, 0.5, 0)));
  robot.orders.clear();
  EXPECT_TRUE(robot.orders.empty());
  EXPECT_EQ(robot.orders.under_way(kRobot), "");
}

}  // namespace
}  // namespace rave::sim::testing
