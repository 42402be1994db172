// SPDX-License-Identifier: Apache-2.0
// Obstacles of the past, and those that the scenario changes at stated steps.
#include <cmath>

#include "obstacle_scene.hpp"

namespace rave::sim::testing {
namespace {

TEST(EngineObstacles, ThePastShowsThemAsTheyWere) {
  const auto engine = make_engine(looker_and_driver());
  const auto seen_at = [&](double t_s) {
    float reading = -1;
    const auto header = engine->sample_at(kLooker, 0, {from_seconds(t_s).ns}, &reading);
    EXPECT_TRUE(header) << t_s;
    return reading;
  };
  run(*engine, 30);  // shows 0.29 s
  ASSERT_TRUE(engine->change_obstacle(add("crate", {2, 0, 0})));
  EXPECT_EQ(seen_at(0.29), kNothing) << "it counts from the next step on";
  run(*engine, 5);
  ASSERT_TRUE(engine->change_obstacle(move("crate", {3, 0, 0})));
  run(*engine, 5);
  ASSERT_TRUE(engine->change_obstacle(take_away("crate")));
  ASSERT_TRUE(engine->change_obstacle(move("post", {4, 0, 0})));
  run(*engine, 5);  // shows 0.44 s
  for (int round = 0; round < 2; ++round) {
    EXPECT_FLOAT_EQ(seen_at(0.3), 1.9F);
    EXPECT_EQ(seen_at(0.299), kNothing);
    EXPECT_FLOAT_EQ(seen_at(0.349), 1.9F);
    EXPECT_FLOAT_EQ(seen_at(0.35), 2.9F);
    EXPECT_FLOAT_EQ(seen_at(0.40), 3.9F);
    EXPECT_FLOAT_EQ(seen_at(0.44), 3.9F);
    EXPECT_FLOAT_EQ(seen_at(0.395), 2.9F);
  }
  // So many changes that the snapshot of the past has missed some that are forgotten by now.
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(engine->change_obstacle(add("c" + std::to_string(k), {1 + 0.05 * k, 0, 0})));
    if (k >= 3) {
      ASSERT_TRUE(engine->change_obstacle(take_away("c" + std::to_string(k - 3))));
    }
    run(*engine, 1);
  }
  // It shows 1.04 s, when c57, c58 and c59 stood; c(k) came at 0.45 s + k steps.
  EXPECT_FLOAT_EQ(seen_at(1.04), static_cast<float>(1 + 0.05 * 57 - 0.1));
  EXPECT_FLOAT_EQ(seen_at(0.901), static_cast<float>(1 + 0.05 * 43 - 0.1));
  EXPECT_FLOAT_EQ(seen_at(1.02), static_cast<float>(1 + 0.05 * 55 - 0.1));
}

TEST(EngineObstacles, AHybridSeesThemAsTheyWereAtTheStamp) {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({6, 0, 0}, 0.2, 1, 1, "wall"));
  RobotType type = real_type({});
  type.sensors[0] = real_sensor<HandFedPose>("mocap", {{"port", 0}});
  type.sensors.push_back(hybrid<HandFedLaser, Laser, Nearest>({{"port", 1}, {"rays", 1}},
                                                              {{"rays", 1}, {"range_m", 9}}));
  type.sensors.push_back(
      hybrid<HandFedBumper, Bumper, JustVirtual<ContactReading>>({{"port", 2}}, {}));
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  struct Seen {
    float range_m = 0;
    bool touching = false;
  };
  // A stamp lies between two steps; the sample comes with the later one.
  const auto step = [&](int k) -> Seen {
    const double t_s = 0.01 * k;
    const double stamp_s = t_s - 0.0037;
    feed_pose(0, t_s, {});
    if (stamp_s >= 0) {
      feed_ranges(1, stamp_s, {8});
      const ContactReading nothing{};
      HandFedBumper::port(2)->publish(at(stamp_s), &nothing, 1);
    }
    complete<HandFedPose>(0, t_s);
    complete<HandFedLaser>(1, t_s);
    complete<HandFedBumper>(2, t_s);
    const Status status = engine->step();
    EXPECT_TRUE(status) << status.error().text();
    const auto* const touch = static_cast<const ContactReading*>(engine->sensor(robot, 2).records);
    return {range(*engine, robot, 1), touch->touching != 0};
  };
  for (int k = 0; k < 50; ++k) {
    if (k == 10) {
      ASSERT_TRUE(engine->change_obstacle(add("crate", {2, 0, 0})));
    }
    if (k == 20) {  // over it
      ASSERT_TRUE(engine->change_obstacle(move("wall", {0.2, 0, 0})));
    }
    if (k == 30) {
      ASSERT_TRUE(engine->change_obstacle(move("wall", {6, 0, 0})));
    }
    if (k == 40) {
      ASSERT_TRUE(engine->change_obstacle(take_away("crate")));
    }
    const Seen seen = step(k);
    if (k < 1) continue;
    const int shown = k - 1;  // the step whose world the stamp falls into
    const float expected_m = shown < 10 || shown >= 40   ? 5.9F
                             : shown < 20 || shown >= 30 ? 1.9F
                                                         : 0.1F;
    EXPECT_FLOAT_EQ(seen.range_m, expected_m) << k;
    EXPECT_EQ(seen.touching, shown >= 20 && shown < 30) << k;
  }
}

TEST(EngineObstacles, ChangesOfTheScenarioBelongToTheRun) {
  const auto go = [](unsigned threads, const Author& author, double x_m = 2) {
    EngineSpec spec = looker_and_driver();
    spec.threads = threads;
    spec.share_always = threads > 1;
    const ObstacleChange changes[] = {add("crate", {x_m, 0, 0}), move("post", {3, 5, 0}),
                                      take_away("crate")};
    if (author == Author::kRun) {
      spec.obstacle_changes = {{10, changes[0]}, {10, changes[1]}, {40, changes[2]}};
    }
    const auto engine = make_engine(std::move(spec));
    for (int k = 0; k < 60; ++k) {
      if (author == Author::kHand && k == 10) {
        EXPECT_TRUE(engine->change_obstacle(changes[0], Author::kRun));
        EXPECT_TRUE(engine->change_obstacle(changes[1], Author::kRun));
      }
      if (author == Author::kHand && k == 40) {
        EXPECT_TRUE(engine->change_obstacle(changes[2], Author::kRun));
      }
      const std::size_t events = run(*engine, 1).size();
      EXPECT_EQ(events, k == 10 ? 2U : k == 40 ? 1U : 0U) << k;
    }
    EXPECT_EQ(engine->inputs_by_hand(), 0U);
    const RunHash first = engine->hash();
    if (author == Author::kRun) {
      EXPECT_TRUE(engine->reset());
      run(*engine, 60);
      EXPECT_EQ(engine->hash(), first);
    }
    return first;
  };
  const RunHash hash = go(1, Author::kRun);
  EXPECT_EQ(go(3, Author::kRun), hash);
  EXPECT_EQ(go(1, Author::kHand), hash);
  EXPECT_NE(go(1, Author::kRun, std::nextafter(2.0, 3.0)), hash);
}

TEST(EngineObstacles, AChangeOfTheScenarioThatCannotBeMadeIsAnEvent) {
  EngineSpec spec = looker_and_driver();
  spec.obstacle_changes = {{10, add("crate", {0, 0, 0})}};
  const auto engine = make_engine(std::move(spec));
  const auto events = run(*engine, 20);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].kind, EventKind::kChangeRefused);
  EXPECT_EQ(events[0].step, 10U);
  EXPECT_FALSE(events[0].robot.valid());
  EXPECT_NE(events[0].text.find("overlap the robot `r0`"), std::string::npos);
  EngineSpec wrong = looker_and_driver();
  wrong.obstacle_changes = {{10, add("", {0, 0, 0})}};
  EXPECT_FALSE(Engine::create(std::move(wrong)));
}

TEST(EngineObstacles, TheHashHoldsWhatNobodySees) {
  const auto hash = [](auto&& change) {
    const auto engine = make_engine(looker_and_driver());
    ObstacleChange crate = add("crate", {-20, 0, 0});
    change(crate);
    EXPECT_TRUE(engine->change_obstacle(crate));
    run(*engine, 1);
    return engine->hash();
  };
  const RunHash plain = hash([](ObstacleChange&) {});
  EXPECT_EQ(hash([](ObstacleChange& crate) { crate.body.colour = "#112233"; }), plain);
  EXPECT_NE(hash([](ObstacleChange& crate) { crate.name = "crete"; }), plain);
  EXPECT_NE(hash([](ObstacleChange& crate) { crate.body.shapes[0].z1_m = 1.5; }), plain);
  EXPECT_NE(hash([](ObstacleChange& crate) { crate.body.code = 0; }), plain);
  EXPECT_NE(hash([](ObstacleChange& crate) { crate.body.layer = Layer::kMappedReal; }), plain);
  EXPECT_NE(hash([](ObstacleChange& crate) { crate.body = box({}, 0.2, 1.1).body; }), plain);
}

}  // namespace
}  // namespace rave::sim::testing
