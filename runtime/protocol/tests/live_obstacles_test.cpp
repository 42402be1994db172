// SPDX-License-Identifier: Apache-2.0
// The world of a host in real time, in which obstacles come, move and go.
#include <gtest/gtest.h>

#include "rave/protocol/live_world.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::real_time {
namespace {

using namespace sim::testing;
using sim::EventKind;
using Kind = sim::ObstacleChange::Kind;

/// A robot that runs here, one that does not, and a post: the next body is number 3.
sim::EngineSpec two_robots() {
  sim::EngineSpec spec;
  spec.world.obstacles.push_back(box({8, 0, 0}, 0.2, 1, 1, "post"));
  add_robot(spec, simulated_type());
  add_robot(spec, simulated_type(), {5, 0, 0});
  spec.local = {RobotId(0)};
  spec.own_authority = true;
  return spec;
}

ObstacleSight crate(std::uint32_t id, std::uint64_t revision, const Pose2& X_WB = {3, 0, 0}) {
  ObstacleSight sight;
  sight.revision = revision;
  sight.stands.id = BodyId(id);
  sight.stands.name = "crate" + std::to_string(id);
  sight.stands.X_WB = X_WB;
  sight.stands.body = box({}, 0.2, 0.2).body;
  sight.stands.asked = R"({"remove_obstacle": "crate"})";
  return sight;
}

class LiveObstacles : public ::testing::Test {
 protected:
  void SetUp() override { make(two_robots(), false); }
  void make(const sim::EngineSpec& spec, bool alone) {
    auto made = LiveWorld::create(spec, alone);
    ASSERT_TRUE(made) << made.error().text();
    live_ = *std::move(made);
  }
  /// The changes of the next step.
  const std::vector<sim::ObstacleChange>& step() {
    own_.begin(number_);
    if (number_ > 0) own_.proposals = {{0}, {0}, {0}, {0}};
    ++number_;
    const Status status = live_->step(own_, world_);
    EXPECT_TRUE(status) << status.error().text();
    return world_.obstacles;
  }

  std::unique_ptr<LiveWorld> live_;
  std::uint64_t number_ = 0;
  sim::HostReport own_;
  sim::WorldStep world_;
};

TEST_F(LiveObstacles, OneComesMovesAndGoes) {
  ASSERT_TRUE(live_->see(crate(3, 1)));
  EXPECT_EQ(live_->heard_revision(), 1U);
  EXPECT_EQ(live_->shown_revision(), 0U);
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].id, BodyId(3));
  EXPECT_EQ(live_->shown_revision(), 1U);
  EXPECT_TRUE(step().empty());
  ASSERT_EQ(live_->events().size(), 1U) << "of the step that is done";
  EXPECT_EQ(live_->events()[0].kind, EventKind::kObstacleAdded);
  EXPECT_FALSE(live_->events()[0].robot.valid());
  EXPECT_NE(live_->events()[0].text.find("(by hand)"), std::string::npos);

  ASSERT_TRUE(live_->see(crate(3, 2, {4, 0, 0})));
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].kind, Kind::kMove);
  EXPECT_EQ(world_.obstacles[0].X_WB.x, 4);
  ObstacleSight gone = crate(3, 3, {4, 0, 0});
  gone.removed = true;
  ASSERT_TRUE(live_->see(gone));
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].kind, Kind::kRemove);
  ASSERT_EQ(live_->events().size(), 1U);
  EXPECT_EQ(live_->events()[0].detail, 2U) << "which change it was, also if the next has come";
  EXPECT_TRUE(step().empty());
  EXPECT_EQ(live_->shown_revision(), 3U);
  ASSERT_EQ(live_->events().size(), 1U);
  EXPECT_EQ(live_->events()[0].detail, 3U);
}

TEST_F(LiveObstacles, WhatIsOldIsNotTakenBack) {
  ASSERT_TRUE(live_->see(crate(3, 5, {4, 0, 0})));
  EXPECT_FALSE(live_->see(crate(3, 4)));
  EXPECT_FALSE(live_->see(crate(3, 5)));
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].X_WB.x, 4);
}

TEST_F(LiveObstacles, ManyThatCameAndWentBeforeAreThereInOneStep) {
  // The later number is heard of first; the first of the two is gone already.
  ASSERT_TRUE(live_->see(crate(4, 2, {4, 0, 0})));
  EXPECT_TRUE(step().empty()) << "it waits for its forerunner";
  EXPECT_EQ(live_->shown_revision(), 0U);
  ObstacleSight gone = crate(3, 3);
  gone.removed = true;
  ASSERT_TRUE(live_->see(gone));
  const auto& changes = step();
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].kind, Kind::kAdd);
  EXPECT_EQ(changes[1].kind, Kind::kRemove);
  EXPECT_EQ(changes[2].id, BodyId(4));
  EXPECT_EQ(live_->shown_revision(), 3U);
}

TEST_F(LiveObstacles, ThoseOfTheStartMoveAndGo) {
  ObstacleSight post;
  post.revision = 1;
  post.stands.kind = Kind::kMove;
  post.stands.id = BodyId(0);
  post.stands.name = "post";
  post.stands.X_WB = {9, 1, 0};
  ASSERT_TRUE(live_->see(post));
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].X_WB.x, 9);
  post.revision = 2;
  post.stands.kind = Kind::kRemove;
  ASSERT_TRUE(live_->see(post));
  ASSERT_EQ(step().size(), 1U);
  EXPECT_EQ(world_.obstacles[0].kind, Kind::kRemove);
}

TEST_F(LiveObstacles, WhatCannotBeIsNotTakenIn) {
  EXPECT_FALSE(live_->see(crate(0, 1))) << "not a new one";
  EXPECT_FALSE(live_->see(crate(2, 1))) << "a robot";
  ObstacleSight shapeless = crate(3, 1);
  shapeless.stands.body.shapes.clear();
  EXPECT_FALSE(live_->see(shapeless));
  ObstacleSight robot = crate(2, 1);
  robot.stands.kind = Kind::kRemove;
  EXPECT_FALSE(live_->see(robot));
  constexpr auto kMost = static_cast<std::uint32_t>(sim::ObstacleChange::kMostAdded);
  EXPECT_TRUE(live_->check(crate(3 + kMost - 1, 1)));
  const Status beyond = live_->check(crate(3 + kMost, 1));
  ASSERT_FALSE(beyond);
  EXPECT_NE(beyond.error().message.find("number 100003 does not belong to the run"),
            std::string::npos)
      << beyond.error().message;
  EXPECT_FALSE(live_->see(crate(3 + kMost, 1)));
  EXPECT_FALSE(live_->see(crate(3, 0)));
  EXPECT_FALSE(live_->see(crate(3, ObstacleSight::kMostRevision + 1)));
  EXPECT_EQ(live_->heard_revision(), 0U);
  EXPECT_TRUE(step().empty());
}

TEST_F(LiveObstacles, OneMayComeWhereARobotIs) {
  ASSERT_TRUE(live_->see(crate(3, 1, {0.1, 0, 0})));
  ASSERT_EQ(step().size(), 1U) << "the manager has looked, as well as it could";
  EXPECT_TRUE(step().empty());
}

TEST_F(LiveObstacles, WhoBeginsLateHasThemInItsFirstStep) {
  ASSERT_TRUE(live_->see(crate(3, 1)));
  own_.begin(0);
  ASSERT_TRUE(live_->begin_at(100, {}, own_));
  ASSERT_TRUE(live_->step(own_, world_));
  EXPECT_EQ(world_.step, 100U);
  ASSERT_EQ(world_.obstacles.size(), 1U);
}

TEST_F(LiveObstacles, WithoutAManagerThoseOfTheScenarioAreMadeHere) {
  sim::EngineSpec spec = two_robots();
  sim::ScheduledObstacle scheduled;
  scheduled.step = 2;
  scheduled.change = crate(3, 1).stands;
  scheduled.change.id = BodyId();
  scheduled.change.asked.clear();
  spec.obstacle_changes = {scheduled};
  make(spec, true);
  EXPECT_TRUE(step().empty());
  EXPECT_TRUE(step().empty());
  ASSERT_EQ(step().size(), 1U);
  EXPECT_TRUE(step().empty());
  ASSERT_EQ(live_->events().size(), 1U);
  EXPECT_EQ(live_->events()[0].text.find("by hand"), std::string::npos);
  EXPECT_EQ(live_->events()[0].detail, 0U) << "nobody counts";
  number_ = 0;
  make(spec, false);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(step().empty()) << "the manager makes them";
}

}  // namespace
}  // namespace rave::real_time
