// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "orders_world.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineOrders, ADriveTakesThePlaceOfTheProgram) {
  const auto engine = make_engine(small_world());
  run(*engine, 10);
  const double before_m = engine->true_pose(kDriver).x;
  EXPECT_NEAR(before_m, 0.02, 1e-9) << "the program drives at 0.2 m/s";
  ASSERT_TRUE(engine->order(drive(kDriver, 0.5, 0)));
  EXPECT_EQ(engine->order_of(kDriver), "drive");
  const auto events = of_kind(run(*engine, 10), EventKind::kOrdered);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step, 10U);
  EXPECT_EQ(events[0].text, "drive 0.50 m/s, 0.00 rad/s (by hand: anna)");
  EXPECT_NEAR(engine->true_pose(kDriver).x - before_m, 0.05, 1e-9);
  // That somebody goes on driving is told once, and counts.
  ASSERT_TRUE(engine->order(drive(kDriver, 0.1, 0)));
  EXPECT_TRUE(of_kind(run(*engine, 10), EventKind::kOrdered).empty());
  EXPECT_NEAR(engine->true_pose(kDriver).x - before_m, 0.06, 1e-9);
  EXPECT_EQ(engine->inputs_by_hand(), 2U);
  ASSERT_TRUE(engine->order(cancel(kDriver)));
  EXPECT_EQ(engine->order_of(kDriver), "");
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(kDriver).x - before_m, 0.08, 1e-9) << "the program has it again";
}

TEST(EngineOrders, PedalsGoToARobotThatHasSome) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, cart_type());
  const auto engine = make_engine(std::move(spec));
  // Without pedals it is the velocity that counts, and of a robot without pedals always.
  ASSERT_TRUE(engine->order(drive(robot, 0.5, 0)));
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(robot).x, 0.05, 1e-9);
  ASSERT_TRUE(engine->order(
      order(robot, request::Drive{0.5, 0, 0, request::Pedals{.throttle = 0.3, .gear = -1}})));
  const auto events = of_kind(run(*engine, 10), EventKind::kOrdered);
  ASSERT_EQ(events.size(), 1U) << "another controller has it now";
  EXPECT_EQ(events[0].text,
            "drive 0.50 m/s, 0.00 rad/s, steering 0.00, throttle 0.30, brake 0.00, gear -1 (by "
            "hand: anna)");
  EXPECT_NEAR(engine->true_pose(robot).x, 0.02, 1e-9);
  ASSERT_TRUE(engine->order(drive(robot, 0, 0)));
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(robot).x, 0.02, 1e-9);
  engine->stop(robot);
  run(*engine, 2);
  EXPECT_EQ(engine->actuator_command(robot, 0), pedals_command(0, 0, 1, 1)) << "it brakes";
  const auto bad = engine->order(order(robot, request::Drive{0, 0, 0, request::Pedals{.gear = 3}}));
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("gear -1, 0 or 1"), std::string::npos) << bad.error().message;
}

TEST(EngineOrders, AProgramIsToldThatItIsDriven) {
  const auto engine = make_engine(small_world());
  ASSERT_TRUE(engine->order(drive(kListener, 0.1, 0)));
  const auto events = of_kind(run(*engine, 3), EventKind::kSaid);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "driven");
}

TEST(EngineOrders, AProgramGetsWhatItTakes) {
  const auto engine = make_engine(small_world());
  run(*engine, 3);
  const WorldInput way = path(kListener, {{1, 0}, {1, 1}}, 0.3);
  ASSERT_TRUE(engine->order(way)) << why(engine->order(way));
  EXPECT_EQ(engine->order_of(kListener), "path of 2 points to 1.00, 1.00");
  ASSERT_TRUE(engine->order(words(kListener, "hello")));
  const auto said = of_kind(run(*engine, 5), EventKind::kSaid);
  ASSERT_EQ(said.size(), 2U) << "each comes once";
  EXPECT_EQ(said[0].text, "path 2 points speed 0.3 by anna");
  EXPECT_EQ(said[1].text, "text hello by anna");
  EXPECT_EQ(said[0].robot, kListener);
  ASSERT_TRUE(engine->order(goal(kListener, {1, 0}, 1)));
  const auto done = of_kind(run(*engine, 5), EventKind::kSaid);
  ASSERT_EQ(done.size(), 1U);
  EXPECT_EQ(done[0].text, "goal 1 points yaw 1 by anna");
  EXPECT_EQ(engine->order_of(kListener), "") << "the program is done with a goal at once";
}

TEST(EngineOrders, AProgramThatIsDoneHearsOfACancelAndOfADriveOnce) {
  const auto engine = make_engine(small_world());
  for (const WorldInput& end : {cancel(kListener), drive(kListener, 0, 0)}) {
    ASSERT_TRUE(engine->order(goal(kListener, {1, 0})));
    run(*engine, 5);
    ASSERT_EQ(engine->order_of(kListener), "") << "it is done";
    ASSERT_TRUE(engine->order(end)) << why(engine->order(end));
    const auto said = of_kind(run(*engine, 5), EventKind::kSaid);
    ASSERT_FALSE(said.empty());
    EXPECT_EQ(said[0].text, "cancel by anna");
    EXPECT_EQ(said.size(), end.is<request::Drive>() ? 2U : 1U) << "beside that it is driven";
    // The drive ends; the program was told of the goal already.
    ASSERT_TRUE(engine->order(cancel(kListener)));
    EXPECT_TRUE(of_kind(run(*engine, 5), EventKind::kSaid).empty());
  }
}

TEST(EngineOrders, OfSeveralGoalsTheLastOneCounts) {
  const auto engine = make_engine(small_world());
  for (const double x_m : {1.0, 2.0, 3.0}) {
    ASSERT_TRUE(engine->order(goal(kListener, {x_m, 0})));
  }
  EXPECT_EQ(of_kind(run(*engine, 3), EventKind::kSaid).size(), 1U);
}

TEST(EngineOrders, AProgramThatTalksTooMuchIsCutShort) {
  EngineSpec spec;
  add_robot(spec, chatterer_type());
  const auto engine = make_engine(std::move(spec));
  const auto events = of_kind(run(*engine, 100), EventKind::kSaid);
  EXPECT_EQ(events.size(), 10U) << "ten in a second";
}

TEST(EngineOrders, AGoalGoesToAControllerIfTheProgramTakesNone) {
  const auto engine = make_engine(small_world());
  run(*engine, 5);
  ASSERT_TRUE(engine->order(goal(kGoalGetter, {0.5, -2})));
  EXPECT_EQ(engine->order_of(kGoalGetter), "goal 0.50, -2.00");
  const auto events = of_kind(run(*engine, 400), EventKind::kOrdered);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].text, "goal 0.50, -2.00: reached");
  EXPECT_EQ(engine->order_of(kGoalGetter), "goal 0.50, -2.00, reached");
  EXPECT_NEAR(engine->true_pose(kGoalGetter).x, 0.5, 0.11) << "it stays there";
}

TEST(EngineOrders, AStopEndsOrdersAndNoneIsTakenUntilRelease) {
  const auto engine = make_engine(small_world());
  ASSERT_TRUE(engine->order(drive(kDriver, 0.5, 0)));
  run(*engine, 5);
  engine->stop(kDriver, {true, "bert"});
  EXPECT_EQ(engine->order_of(kDriver), "");
  const auto events = of_kind(run(*engine, 2), EventKind::kStopped);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "by hand: bert");
  EXPECT_NE(why(engine->order(drive(kDriver, 0.5, 0))).find("it is stopped"), std::string::npos);
  engine->release(kDriver);
  const double x_m = engine->true_pose(kDriver).x;
  run(*engine, 10);
  EXPECT_NEAR(engine->true_pose(kDriver).x - x_m, 0.02, 1e-9) << "its program, not the drive";
}

TEST(EngineOrders, TheGuardStaysInForce) {
  EngineSpec spec;
  RobotType type = driver_type();
  type.guard = GuardSpec{};
  type.guard->max_speed_mps = 0.3;
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->order(drive(robot, 1, 0)));
  const auto events = run(*engine, 200);
  EXPECT_EQ(of_kind(events, EventKind::kGuardSlowed).size(), 1U);
  EXPECT_NEAR(engine->true_pose(robot).x, 0.6, 1e-6) << "and no watchdog stops it";
}

TEST(EngineOrders, PlacePutsARobotElsewhereAndMakesNoOverlap) {
  const auto engine = make_engine(small_world());
  run(*engine, 5);
  ASSERT_TRUE(engine->order(place(kListener, {2, 1}, 1.5)));
  const auto events = of_kind(run(*engine, 1), EventKind::kPlaced);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "place 2.00, 1.00, yaw 86 deg (by hand: anna)");
  EXPECT_NEAR(engine->snapshot().pose(kListener).x, 2, 0.01);
  EXPECT_NEAR(engine->snapshot().pose(kListener).yaw, 1.5, 0.01);
  EXPECT_NE(why(engine->order(place(kListener, {4, 0}))).find("it would overlap `wall`"),
            std::string::npos);
  EXPECT_NE(why(engine->order(place(kListener, {3.8, 0}))).find("it would overlap `wall`"),
            std::string::npos);
  EXPECT_NE(why(engine->order(place(kDriver, {2, 1}))).find("it would overlap `r0`"),
            std::string::npos);
  EXPECT_TRUE(engine->order(place(kListener, {3.7, 0}))) << "beside it there is room";
  run(*engine, 1);
}

TEST(EngineOrders, ARefusedOrderLeavesEverythingAsItWas) {
  const auto untouched = [](auto&& spoil) {
    EngineSpec spec = small_world();
    spec.types[0].guard = GuardSpec{};
    spec.types[0].guard->fence_W = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
    add_robot(spec, real_type({{"x", 2}, {"y", 3}}), {2, 3, 0});
    const auto engine = make_engine(std::move(spec));
    run(*engine, 10);
    spoil(*engine);
    EXPECT_EQ(engine->inputs_by_hand(), 0U);
    run(*engine, 30);
    return engine->hash();
  };
  const RunHash plain = untouched([](Engine&) {});
  const auto refused = [&](const std::string& text, const WorldInput& input) {
    EXPECT_EQ(untouched([&](Engine& engine) {
                const Status status = engine.order(input);
                if (!input.is<request::Place>()) {
                  EXPECT_EQ(why(engine.check_order(input)), why(status));
                }
                ASSERT_FALSE(status) << text;
                EXPECT_NE(status.error().message.find(text), std::string::npos)
                    << status.error().message;
              }),
              plain)
        << text;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused("expected at most 100 m/s", drive(kDriver, nan, 0));
  refused("expected at most 100 m/s", drive(kDriver, 0, std::numeric_limits<double>::infinity()));
  refused("expected at most 100 m/s", drive(kDriver, 101, 0));
  refused("is not a point", goal(kListener, {nan, 0}));
  refused("is outside the world", goal(kListener, {1e6, 0}));
  refused("is inside the obstacle `wall`", goal(kListener, {4, 1}));
  refused("is outside the fence", goal(kListener, {3.5, 0}));
  refused("is not a yaw", place(kListener, {1, 1}, nan));
  refused("`path` needs a robot", path(RobotId(), {}));
  refused("`goal` needs a robot", goal(RobotId(99), {0, 0}));
  const auto path_of = [](std::size_t points) {
    return path(kListener, std::vector<Vec2>(points, {1, 0}));
  };
  refused("1 point; expected 2 to 1000", path_of(1));
  refused("10000 points; expected 2 to 1000", path_of(10'000));
  refused("its program takes no paths", path(kDriver, {{1, 0}, {2, 0}}));
  refused("neither its program nor one of its controllers takes goals", goal(kDriver, {1, 0}));
  refused("its program takes no texts", words(kDriver, "hello"));
  refused("0 bytes; expected 1 to 1000", words(kListener, ""));
  refused("1001 bytes; expected 1 to 1000", words(kListener, std::string(1001, 'a')));
  refused("control characters", words(kListener, "a\x1b[2J"));
  refused("a velocity that an actuator obeys", drive(RobotId(3), 0.1, 0));
  refused("a real robot cannot be placed", place(RobotId(3), {1, 1}));
}

TEST(EngineOrders, ARobotSaysWhatItTakes) {
  const auto engine = make_engine(small_world());
  const OrderSet always = order_bit(OrderKind::kDrive) | order_bit(OrderKind::kPlace);
  EXPECT_EQ(engine->takes(kDriver), always);
  EXPECT_EQ(engine->takes(kGoalGetter), always | order_bit(OrderKind::kGoal));
  EXPECT_EQ(engine->takes(kListener), always | kTakesGoal | kTakesPath | kTakesText);
}

TEST(EngineOrders, AResetForgetsThem) {
  const auto engine = make_engine(small_world());
  run(*engine, 50);
  const RunHash plain = engine->hash();
  ASSERT_TRUE(engine->reset());
  ASSERT_TRUE(engine->order(drive(kDriver, 0.5, 0)));
  ASSERT_TRUE(engine->order(place(kListener, {2, 1})));
  run(*engine, 50);
  EXPECT_NE(engine->hash(), plain);
  ASSERT_TRUE(engine->reset());
  EXPECT_EQ(engine->order_of(kDriver), "");
  run(*engine, 50);
  EXPECT_EQ(engine->hash(), plain);
}

}  // namespace
}  // namespace rave::sim::testing
