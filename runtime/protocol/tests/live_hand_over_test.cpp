// SPDX-License-Identifier: Apache-2.0
// A robot of one of several hosts in real time changes its drivers, and others are told.
#include <gtest/gtest.h>

#include <optional>

#include "rave/protocol/live_world.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::real_time {
namespace {

using namespace sim::testing;

constexpr RobotId kChanges{0};
constexpr RobotId kPlain{1};

/// A robot that is real first and has simulated drivers, too, and a simulated one 5 m away.
sim::EngineSpec with_a_twin(RobotId local) {
  sim::EngineSpec spec;
  sim::RobotType simulated = simulated_type();
  simulated.sensors.push_back(virtual_sensor<Beacon>("mocap"));
  add_robot(spec, real_type({{"x", 1}, {"y", 2}, {"vx", 0.5}}));
  spec.robots.back().twin = static_cast<std::uint32_t>(spec.types.size());
  spec.types.push_back(std::move(simulated));
  add_robot(spec, simulated_type(), {5, 0, 0});
  spec.local = {local};
  spec.own_authority = true;
  return spec;
}

/// A host without its end of the bus.
class Host {
 public:
  explicit Host(RobotId local, std::optional<std::uint64_t> handed_over_at = {}) : local_(local) {
    sim::EngineSpec spec = with_a_twin(local);
    if (handed_over_at) spec.hand_overs = {{*handed_over_at, kChanges, sim::DriverSet::kTwin}};
    auto made = sim::Engine::create(std::move(spec));
    EXPECT_TRUE(made) << made.error().text();
    engine = *std::move(made);
    auto live = LiveWorld::create(engine->spec());
    EXPECT_TRUE(live) << live.error().text();
    world = *std::move(live);
    type_ = engine->spec().robots[local.value()].type;
    EXPECT_TRUE(engine->propose(report_));
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      const std::uint32_t type = engine->spec().robots[local_.value()].type;
      if (type != type_) {
        ASSERT_TRUE(world->serve(local_, type, engine->true_pose(local_)));
        type_ = type;
      }
      const Status made = world->step(report_, step_);
      ASSERT_TRUE(made) << made.error().text();
      const Status joined = engine->join(step_, {});
      ASSERT_TRUE(joined) << joined.error().text();
      const Status proposed = engine->propose(report_);
      ASSERT_TRUE(proposed) << proposed.error().text();
      const auto news = engine->events();
      events.insert(events.end(), news.begin(), news.end());
    }
  }
  [[nodiscard]] Layer layer_of(RobotId robot) const {
    return engine->spec().world.robots[robot.value()].layer;
  }

  std::unique_ptr<sim::Engine> engine;
  std::unique_ptr<LiveWorld> world;
  std::vector<sim::Event> events;

 private:
  RobotId local_;
  std::uint32_t type_ = 0;
  sim::HostReport report_;
  sim::WorldStep step_;
};

TEST(LiveHandOver, ARobotIsHandedOverByItsHostAndTheRunGoesOn) {
  Host host(kChanges);
  host.steps(100);
  const double reported_m = host.engine->reported(kChanges).pose.x_m;
  EXPECT_NEAR(reported_m, 1.5, 0.03);
  ASSERT_TRUE(host.engine->hand_over(kChanges, sim::DriverSet::kTwin));
  host.steps(30);
  ASSERT_EQ(of_kind(host.events, sim::EventKind::kHandedOver).size(), 1U);
  EXPECT_EQ(host.layer_of(kChanges), Layer::kSimulatedRobots);
  EXPECT_TRUE(host.engine->snapshot().robot(kChanges).present);
  EXPECT_NEAR(host.engine->true_pose(kChanges).x, reported_m, 0.1) << "it stands where it was";
  const double stands_m = host.engine->true_pose(kChanges).x;
  host.steps(20);
  EXPECT_NEAR(host.engine->true_pose(kChanges).x, stands_m, 1e-9) << "nobody reports it any more";
}

TEST(LiveHandOver, ThoseOfTheScenarioAreMadeWhereTheRobotRuns) {
  Host there(kChanges, 10);
  there.steps(30);
  EXPECT_EQ(of_kind(there.events, sim::EventKind::kHandedOver).size(), 1U);
  Host elsewhere(kPlain, 10);
  elsewhere.steps(30);
  EXPECT_TRUE(elsewhere.events.empty()) << elsewhere.events.front().text;
}

TEST(LiveHandOver, OtherHostsSeeWhatItIs) {
  Host host(kPlain);
  ASSERT_TRUE(host.world->see(RobotSight{kChanges, {}, {1, 2, 0}, {}}));
  host.steps(3);
  EXPECT_EQ(host.layer_of(kChanges), Layer::kRealRobots);
  ASSERT_TRUE(host.engine->show_reality(kChanges, true));
  ASSERT_TRUE(host.world->set_reality(kChanges, true));
  host.steps(3);
  EXPECT_EQ(host.layer_of(kChanges), Layer::kSimulatedRobots);
  EXPECT_TRUE(host.engine->snapshot().robot(kChanges).present);
  EXPECT_NEAR(host.engine->snapshot().pose(kChanges).x, 1, 1e-9);
  ASSERT_TRUE(host.world->see(RobotSight{kChanges, {20'000'000}, {1.1, 2, 0}, {}}));
  ASSERT_TRUE(host.engine->show_reality(kChanges, false));
  ASSERT_TRUE(host.world->set_reality(kChanges, false));
  host.steps(3);
  EXPECT_EQ(host.layer_of(kChanges), Layer::kRealRobots);
  EXPECT_TRUE(host.engine->snapshot().robot(kChanges).present);
  EXPECT_NEAR(host.engine->snapshot().pose(kChanges).x, 1.1, 1e-9);
}

TEST(LiveHandOver, HowLongItMayBeSilentIsAsItsDriversSay) {
  sim::EngineSpec spec = with_a_twin(kPlain);
  spec.types[0].staleness = from_seconds(0.5);
  spec.types[1].staleness = from_seconds(2);
  auto world = LiveWorld::create(spec).value();
  sim::HostReport own;
  sim::WorldStep step;
  std::uint64_t number = 0;
  const auto is_stale_after = [&](std::uint64_t until) {
    for (; number <= until; ++number) {
      own.begin(number);
      if (number > 0) own.proposals = {{1}, {0}, {0}, {0}};
      EXPECT_TRUE(world->step(own, step));
    }
    for (const sim::PoseReport& pose : step.poses) {
      if (pose.robot == kChanges) return pose.reported.stale;
    }
    ADD_FAILURE() << "nothing of the robot";
    return false;
  };
  ASSERT_TRUE(world->see({kChanges, SimTime{}, {1, 2, 0}, {}}));
  EXPECT_FALSE(is_stale_after(50));
  EXPECT_TRUE(is_stale_after(60)) << "real";
  ASSERT_TRUE(world->set_reality(kChanges, true));
  EXPECT_FALSE(is_stale_after(199)) << "simulated";
  ASSERT_TRUE(world->set_reality(kChanges, false));
  EXPECT_TRUE(is_stale_after(200)) << "real again";
}

TEST(LiveHandOver, WhoIsNoLongerRealHasNoPast) {
  for (const bool becomes_simulated : {false, true}) {
    auto world = LiveWorld::create(with_a_twin(kPlain)).value();
    ASSERT_TRUE(world->see({kChanges, SimTime{}, {1, 2, 0}, {}}));
    ASSERT_TRUE(!becomes_simulated || world->set_reality(kChanges, true));
    sim::HostReport own;
    sim::WorldStep step;
    own.begin(0);
    ASSERT_TRUE(world->step(own, step));
    EXPECT_EQ(step.samples.size(), becomes_simulated ? 0U : 1U);
  }
}

TEST(LiveHandOver, WhatCannotBeIsRefused) {
  Host host(kChanges);
  host.steps(2);
  EXPECT_FALSE(host.engine->show_reality(kPlain, false)) << "it has one set of drivers";
  EXPECT_TRUE(host.engine->show_reality(kPlain, true)) << "which it is";
  EXPECT_FALSE(host.world->set_reality(kChanges, true)) << "it runs here";
  EXPECT_FALSE(host.world->set_reality(RobotId(2), true)) << "there is none";
  EXPECT_FALSE(host.world->serve(kPlain, 0, {})) << "it runs elsewhere";
  EXPECT_FALSE(host.world->serve(kChanges, 9, {})) << "no such type";
  host.steps(2);
}

}  // namespace
}  // namespace rave::real_time
