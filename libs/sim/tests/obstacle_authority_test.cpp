// SPDX-License-Identifier: Apache-2.0
// An authority over obstacles alone, as a run in real time has one, and one that follows another.
#include <gtest/gtest.h>

#include "rave/sim/world_authority.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

using Kind = ObstacleChange::Kind;

/// A post, a simulated robot and a real one: the next body is number 3.
EngineSpec post_and_robots() {
  EngineSpec spec;
  spec.world.obstacles.push_back(box({8, 0, 0}, 0.2, 1, 1, "post"));
  add_robot(spec, simulated_type());
  add_robot(spec, real_type({{"dt", 0.1}}), {5, 0, 0});
  spec.own_authority = true;
  return spec;
}

std::unique_ptr<WorldAuthority> authority() {
  auto made = WorldAuthority::create(post_and_robots(), {0, 0});
  EXPECT_TRUE(made) << made.error().text();
  return *std::move(made);
}

ObstacleChange crate(const std::string& name, const Pose2& X_WB) {
  ObstacleChange change;
  change.name = name;
  change.X_WB = X_WB;
  change.body = box({}, 0.2, 0.2).body;
  return change;
}

ObstacleChange change_of(Kind kind, const std::string& name, const Pose2& X_WB = {}) {
  ObstacleChange change;
  change.kind = kind;
  change.name = name;
  change.X_WB = X_WB;
  return change;
}

TEST(ObstacleAuthority, DecidesAtOnceByWhereRobotsAreSaidToBe) {
  const auto keeper = authority();
  keeper->place(RobotId(0), {3, 0, 0}, true);
  keeper->place(RobotId(1), {5, 0, 0}, true);
  std::string note;
  const auto over = keeper->decide(crate("lid", {3.1, 0, 0}), SimTime{5}, note);
  ASSERT_FALSE(over);
  EXPECT_NE(over.error().message.find("would overlap the robot `"), std::string::npos);
  const auto made = keeper->decide(crate("lid", {5.1, 0, 0}), SimTime{5}, note);
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->id, BodyId(3));
  EXPECT_NE(note.find("over the real robot"), std::string::npos) << note;
  keeper->place(RobotId(0), {9, 9, 0}, true);
  EXPECT_TRUE(keeper->decide(crate("crate", {3.1, 0, 0}), SimTime{6}, note));
  EXPECT_FALSE(keeper->decide(crate("crate", {2, 2, 0}), SimTime{7}, note)) << "the name is taken";
}

TEST(ObstacleAuthority, AnotherGoesOnWithWhatStands) {
  const auto first = authority();
  std::string note;
  ASSERT_TRUE(first->decide(crate("a", {1, 3, 0}), SimTime{1}, note));
  ASSERT_TRUE(first->decide(crate("b", {2, 3, 0}), SimTime{2}, note));
  ASSERT_TRUE(first->decide(change_of(Kind::kMove, "a", {1, 4, 0}), SimTime{3}, note));
  ASSERT_TRUE(first->decide(change_of(Kind::kRemove, "b"), SimTime{4}, note));
  ASSERT_TRUE(first->decide(change_of(Kind::kRemove, "post"), SimTime{5}, note));
  const AuthorityState state = first->state();
  EXPECT_EQ(state.obstacle_changes, 5U);
  const auto second = authority();
  ASSERT_TRUE(second->put_obstacles(state.obstacles, SimTime{6}));
  EXPECT_EQ(second->world().added.size(), 2U);
  EXPECT_EQ(second->world().added[0].X_WB.y, 4);
  EXPECT_TRUE(second->world().added[1].removed);
  EXPECT_TRUE(second->world().obstacles[0].removed);
  const auto next = second->decide(crate("c", {2, 3, 0}), SimTime{7}, note);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->id, BodyId(5)) << "the number of one that went stays taken";

  std::vector<ObstacleChange> gap(state.obstacles.begin() + 1, state.obstacles.end());
  const Status refused = second->put_obstacles(gap, SimTime{8});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("added, but number 3 comes next"), std::string::npos)
      << refused.error().message;
  EXPECT_EQ(second->world().added.size(), 3U) << "nothing has changed";
}

TEST(ObstacleAuthority, WhoIsNotToldOfObstaclesDoesNotGoOn) {
  const auto first = authority();
  WorldStep world;
  world.begin(4, 2);
  AuthorityState state;
  state.obstacle_changes = 2;
  const Status untold = first->resume(world, state);
  ASSERT_FALSE(untold);
  EXPECT_EQ(untold.error().message,
            "obstacles had changed 2 times before this world, but the changes are missing");
  ObstacleChange added = crate("a", {1, 3, 0});
  added.id = BodyId(3);
  state.obstacles = {added, added};
  EXPECT_FALSE(first->resume(world, state)) << "two of one number";
  state.obstacles = {added};
  ObstacleChange moved = change_of(Kind::kMove, "a", {1, 9, 0});
  moved.id = BodyId(3);
  world.obstacles = {moved};
  ASSERT_TRUE(first->resume(world, state));
  EXPECT_EQ(first->world().added.at(0).X_WB.y, 9);
  EXPECT_EQ(first->state().obstacles.size(), 1U) << "that of the world is told with the world";
  EXPECT_EQ(first->state().obstacle_changes, 2U);
}

TEST(ObstacleAuthority, WhoGoesOnKnowsWhatWasRefusedBefore) {
  const auto first = authority();
  WorldStep world;
  world.begin(4, 2);
  AuthorityState state;
  const auto refused = [](std::uint64_t step, std::string text) {
    return Event{step, RobotId(), EventKind::kChangeRefused, BodyId(), std::move(text), 0};
  };
  state.events = {refused(4, "")};
  state.refused = {refused(2, "in the way"), refused(4, "no such name")};
  state.refused_count = 1;
  EXPECT_FALSE(first->resume(world, state)) << "more are told than there were";
  state.refused_count = 2;
  state.refused.back().step = 5;
  EXPECT_FALSE(first->resume(world, state)) << "of a step that nobody has made";
  state.refused.back().step = 4;
  ASSERT_TRUE(first->resume(world, state));
  ASSERT_EQ(first->refused().size(), 2U);
  EXPECT_EQ(first->refused()[0].text, "in the way");
  const AuthorityState again = first->state();
  EXPECT_EQ(again.refused_count, 2U);
  EXPECT_EQ(again.events.at(0).text, "no such name");
  first->reset();
  EXPECT_TRUE(first->refused().empty());
  EXPECT_EQ(first->refused_count(), 0U);
}

}  // namespace
}  // namespace rave::sim::testing
