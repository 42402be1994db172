// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go while a run goes.
#include <cmath>

#include "obstacle_scene.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineObstacles, AreSeenFromTheStatedStepOn) {
  const auto engine = make_engine(looker_and_driver());
  run(*engine, 20);
  EXPECT_EQ(range(*engine, kLooker, 0), kNothing);
  const auto crate = engine->change_obstacle(add("crate", {2, 0, 0}));
  ASSERT_TRUE(crate) << crate.error().text();
  EXPECT_EQ(crate->id, BodyId(3)) << "behind the post and two robots";
  EXPECT_EQ(crate->step, 20U);
  EXPECT_EQ(crate->text, "`crate` at (2, 0), yaw 0 rad (by hand)");
  const auto events = run(*engine, 1);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kObstacleAdded);
  EXPECT_EQ(events[0].step, 20U);
  EXPECT_FALSE(events[0].robot.valid());
  EXPECT_EQ(events[0].other, crate->id);
  EXPECT_EQ(events[0].text, crate->text);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 1.9F);
  EXPECT_EQ(seen(*engine), 3U);
  run(*engine, 10);
  ASSERT_TRUE(engine->change_obstacle(move("crate", {3, 0, 0})));
  EXPECT_EQ(run(*engine, 1).at(0).kind, EventKind::kObstacleMoved);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 2.9F);
  run(*engine, 10);
  ASSERT_TRUE(engine->change_obstacle(move("post", {2.5, 0, 0}))) << "those of the start, too";
  run(*engine, 1);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 2.4F);
  EXPECT_EQ(seen(*engine), 0U);
  ASSERT_TRUE(engine->change_obstacle(take_away("post")));
  EXPECT_EQ(run(*engine, 1).at(0).kind, EventKind::kObstacleRemoved);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 2.9F);
  EXPECT_EQ(seen(*engine), 3U) << "numbers of others stay";
  ASSERT_TRUE(engine->change_obstacle(take_away("crate")));
  run(*engine, 1);
  EXPECT_EQ(range(*engine, kLooker, 0), kNothing);
  const auto again = engine->change_obstacle(add("crate", {2, 0, 0}));
  ASSERT_TRUE(again);
  EXPECT_EQ(again->id, BodyId(4)) << "no number is used twice";
  EXPECT_EQ(engine->inputs_by_hand(), 6U);
}

TEST(EngineObstacles, StopRobotsAndLetThemGo) {
  const auto engine = make_engine(looker_and_driver());
  run(*engine, 40);
  const double x_m = engine->true_pose(kDriver).x;
  ASSERT_TRUE(engine->change_obstacle(add("gate", {x_m + 0.15 + 0.12, 5, 0})));
  const auto events = run(*engine, 50);
  EXPECT_NEAR(engine->true_pose(kDriver).x, x_m + 0.02, 1e-3);
  const auto contacts = of_kind(events, EventKind::kContact);
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].other, BodyId(3));
  ASSERT_TRUE(engine->change_obstacle(move("gate", {x_m + 1, 5, 0})));
  run(*engine, 100);
  EXPECT_NEAR(engine->true_pose(kDriver).x, x_m + 0.52, 1e-2);
  ASSERT_TRUE(engine->change_obstacle(take_away("gate")));
  run(*engine, 200);
  EXPECT_NEAR(engine->true_pose(kDriver).x, x_m + 1.52, 1e-2);
}

TEST(EngineObstacles, AreResetToThoseOfTheStart) {
  const auto engine = make_engine(looker_and_driver());
  run(*engine, 60);
  const RunHash plain = engine->hash();
  RunHash edited;
  for (int round = 0; round < 2; ++round) {
    ASSERT_TRUE(engine->reset());
    EXPECT_EQ(engine->spec().world.body_count(), 3U);
    run(*engine, 60);
    EXPECT_EQ(engine->hash(), plain);
    ASSERT_TRUE(engine->reset());
    run(*engine, 10);
    ASSERT_TRUE(engine->change_obstacle(add("crate", {2, 0, 0})));
    ASSERT_TRUE(engine->change_obstacle(take_away("post")));
    run(*engine, 10);
    float reading = 0;
    ASSERT_TRUE(engine->sample_at(kLooker, 0, {from_seconds(0.15).ns}, &reading));
    EXPECT_FLOAT_EQ(reading, 1.9F);
    run(*engine, 40);
    if (round == 1) {
      EXPECT_EQ(engine->hash(), edited);
    }
    edited = engine->hash();
    EXPECT_NE(edited, plain);
  }
  ASSERT_TRUE(engine->reset());
  EXPECT_EQ(engine->inputs_by_hand(), 0U);
  ASSERT_TRUE(engine->change_obstacle(move("post", {2, 0, 0})));
  run(*engine, 1);
  EXPECT_EQ(seen(*engine), 0U);
}

/// A code is free again when its bearer has gone.
TEST(EngineObstacles, WithACodeThatAnotherCarriesAreRefused) {
  const auto engine = make_engine(looker_and_driver());
  run(*engine, 10);
  const auto coded = [](const std::string& name, double x_m) {
    ObstacleChange change = add(name, {x_m, 20, 0});
    change.body.code = 7;
    return change;
  };
  ASSERT_TRUE(engine->change_obstacle(coded("a", 20)));
  const auto second = engine->change_obstacle(coded("b", 30));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().text(),
            "`a` already carries the code 7; expected another code for the obstacle `b`");
  ASSERT_TRUE(engine->change_obstacle(add("c", {40, 20, 0}))) << "without a code";
  ASSERT_TRUE(engine->change_obstacle(take_away("a")));
  EXPECT_TRUE(engine->change_obstacle(coded("b", 30)));
}

TEST(EngineObstacles, ARefusedChangeLeavesEverythingAsItWas) {
  const auto after = [](auto&& spoil) {
    const auto engine = make_engine(looker_and_driver());
    run(*engine, 10);
    spoil(*engine);
    EXPECT_EQ(engine->inputs_by_hand(), 0U);
    run(*engine, 50);
    return engine->hash();
  };
  const RunHash plain = after([](Engine&) {});
  const auto refused = [&](const std::string& why, const ObstacleChange& change) {
    const auto ask = [&](Engine& engine) {
      const auto answer = engine.change_obstacle(change);
      ASSERT_FALSE(answer) << why;
      EXPECT_NE(answer.error().text().find(why), std::string::npos) << answer.error().text();
    };
    EXPECT_EQ(after(ask), plain) << why;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused("there is no obstacle `pst`; did you mean `post`?", take_away("pst"));
  refused("there already is an obstacle `post` (number 0)", add("post", {3, 0, 0}));
  refused("x is nan; expected within +-10000000 m", add("crate", {nan, 0, 0}));
  refused("y is -inf", move("post", {0, -std::numeric_limits<double>::infinity(), 0}));
  refused("x is 20000000", move("post", {2e7, 0, 0}));
  refused("yaw is nan", move("post", {0, 0, nan}));
  refused("needs a name", add("", {3, 0, 0}));
  refused("a control character", add("a\nb", {3, 0, 0}));
  refused("has 65 bytes", add(std::string(65, 'x'), {3, 0, 0}));
  refused("overlap the robot `r0` at (0.000, 0.000)", add("crate", {0.2, 0, 0}));
  refused("overlap the robot `r0`", move("post", {0.2, 0, 0}));
  ObstacleChange strange = add("crate", {3, 0, 0});
  strange.body.shapes.clear();
  refused("has 0 convex shapes; expected 1 to 64", strange);
  strange = add("crate", {3, 0, 0});
  strange.body.shapes.resize(65, strange.body.shapes[0]);
  refused("has 65 convex shapes", strange);
  strange = add("crate", {3, 0, 0});
  strange.body.shapes[0].z1_m = nan;
  refused("a height range", strange);
  strange.body.shapes[0] = world::make_disc({}, 1, 0, 1).value();
  strange.body.shapes[0].radius_m = -1;
  refused("a radius above 0", strange);
  strange.body.shapes[0].radius_m = 2e6;
  refused("reaches 2000000 m from its origin", strange);
  strange = add("crate", {3, 0, 0});
  strange.body.layer = Layer::kSimulatedRobots;
  refused("its layer is one of robots", strange);
  ObstacleChange by_number = take_away("");
  by_number.id = BodyId(1);  // a robot
  refused("there is no obstacle 1", by_number);
  by_number.id = BodyId(77);
  refused("there is no obstacle 77", by_number);
  by_number.kind = ObstacleChange::Kind{7};
  refused("the kind of the obstacle change is unknown", by_number);
}

TEST(EngineObstacles, WhatHasGoneCannotBeChangedAndWhatHasTwoNamesNeedsANumber) {
  EngineSpec spec = looker_and_driver();
  spec.world.obstacles.push_back(box({9, 9, 0}, 0.2, 1, 1, "post"));
  const auto engine = make_engine(std::move(spec));
  EXPECT_EQ(engine->change_obstacle(take_away("post")).error().text(),
            "2 obstacles are named `post`; give the number of one instead");
  ObstacleChange change = take_away("");
  change.id = BodyId(0);
  ASSERT_TRUE(engine->change_obstacle(change));
  EXPECT_EQ(engine->change_obstacle(change).error().text(),
            "there is no obstacle 0; `post` has been removed");
  EXPECT_TRUE(engine->change_obstacle(take_away("post"))) << "one is left";
  EXPECT_TRUE(engine->change_obstacle(add("post", {3, 0, 0}))) << "the name is free again";
}

TEST(EngineObstacles, WhatOverlapsAlreadyMayOnlyGetLess) {
  EngineSpec spec = looker_and_driver();
  spec.world.obstacles.push_back(box({0.2, 0, 0}, 0.2, 0.2, 1, "intruder"));
  const auto engine = make_engine(std::move(spec));
  EXPECT_FALSE(engine->change_obstacle(move("intruder", {0.18, 0, 0})));
  EXPECT_TRUE(engine->change_obstacle(move("intruder", {0.22, 0, 0})));
  EXPECT_TRUE(engine->change_obstacle(move("intruder", {2, 0, 0})));
}

TEST(EngineObstacles, MayBePutOverRealRobotsWhichAreTold) {
  EngineSpec spec = looker_and_driver();
  const RobotId real = add_robot(spec, real_type({{"x", -3}}));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 5);
  const auto put = engine->change_obstacle(add("crate", {-3, 0, 0}));
  ASSERT_TRUE(put) << put.error().text();
  EXPECT_EQ(put->text, "`crate` at (-3, 0), yaw 0 rad, over the real robot `r2` (by hand)");
  const auto events = run(*engine, 3);
  ASSERT_EQ(of_kind(events, EventKind::kContact).size(), 1U);
  EXPECT_EQ(of_kind(events, EventKind::kContact)[0].robot, real);
  EXPECT_DOUBLE_EQ(engine->true_pose(real).x, -3);
}

TEST(EngineObstacles, AboveARobotThereIsRoom) {
  const auto engine = make_engine(looker_and_driver());
  ObstacleChange bridge = add("bridge", {0, 0, 0}, 4, 4);
  for (world::Shape& shape : bridge.body.shapes) {
    shape.z0_m = 0.5;
    shape.z1_m = 1;
  }
  EXPECT_TRUE(engine->change_obstacle(bridge));
}

TEST(EngineObstacles, ARobotGrowsAsFarAsThoseThatCameLetIt) {
  const auto engine = make_engine(looker_and_driver());
  ASSERT_TRUE(engine->change_obstacle(add("crate", {0.4, 0, 0})));
  const ParameterChange scale[] = {{ParameterChange::Part::kBody, 0, "scale", 3.0}};
  const Status status = engine->set_parameters(kLooker, scale);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().text().find("overlap `crate`"), std::string::npos);
  ASSERT_TRUE(engine->change_obstacle(take_away("crate")));
  EXPECT_TRUE(engine->set_parameters(kLooker, scale));
}

TEST(EngineObstacles, AreSeenRightAfterABodyHasChanged) {
  EngineSpec spec = looker_and_driver();
  // So long that the index cuts it into pieces, more of them the larger it gets.
  const RobotId bus = add_twin(spec, {0, 9, 0});
  const std::vector<Vec2> outline = {{-0.8, -0.1}, {0.8, -0.1}, {0.8, 0.1}, {-0.8, 0.1}};
  spec.world.robots[bus.value()].shapes = world::make_prisms(outline, 0, 0.3).value();
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->change_obstacle(add("far", {4, 0, 0})));
  ASSERT_TRUE(engine->change_obstacle(add("near", {2, 0, 0})));
  run(*engine, 10);
  const ParameterChange scale[] = {{ParameterChange::Part::kBody, 0, "scale", 4.0}};
  ASSERT_TRUE(engine->set_parameters(bus, scale));
  run(*engine, 10);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 1.9F);
  EXPECT_EQ(seen(*engine), 5U);
  ASSERT_TRUE(engine->change_obstacle(take_away("near")));
  run(*engine, 10);
  EXPECT_FLOAT_EQ(range(*engine, kLooker, 0), 3.9F);
}

}  // namespace
}  // namespace rave::sim::testing
