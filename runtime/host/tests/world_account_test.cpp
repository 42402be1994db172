// SPDX-License-Identifier: Apache-2.0
#include "../src/world_account.hpp"

#include <gtest/gtest.h>

namespace rave::runtime::testing {
namespace {

using sim::EventKind;

sim::WorldStep world_of(std::uint64_t step, std::vector<sim::ResizedRobot> resized = {}) {
  sim::WorldStep world;
  world.begin(step, 2);
  world.resized = std::move(resized);
  return world;
}

/// The world of this step, which says that robot 0 began to touch robot 1 in the step before.
sim::AuthorityState touched_before(std::uint64_t step) {
  sim::AuthorityState state;
  state.done = {{step - 1, RobotId(0), EventKind::kContact, BodyId(1), "", 0}};
  return state;
}

/// In step 4 robot 1 becomes twice as large.
sim::EngineSpec growing() {
  sim::EngineSpec spec;
  sim::ParameterChange change;
  change.part = sim::ParameterChange::Part::kBody;
  change.name = "scale";
  change.value = 2.0;
  sim::ScheduledChange scheduled;
  scheduled.step = 4;
  scheduled.robot = RobotId(1);
  scheduled.changes = {change};
  spec.changes = {scheduled};
  return spec;
}

TEST(WorldAccount, TellsWhatHappenedInTheStepsThatAreDone) {
  const config::ExpandedScenario scenario;
  const sim::EngineSpec spec = growing();
  WorldAccount account(scenario, spec);
  for (std::uint64_t step = 0; step < 3; ++step) account.take(world_of(step), {});
  account.take(world_of(3), touched_before(3));
  account.take(world_of(4, {{RobotId(1), 2.0}}), {});
  account.take(world_of(5, {{RobotId(1), 3.0}}), {});
  sim::WorldStep last = world_of(6, {{RobotId(1), 1.0}});
  last.last = true;
  account.take(last, touched_before(6));
  const WorldFacts facts = account.facts();
  EXPECT_EQ(facts.first_step, 0U);
  EXPECT_EQ(facts.next_step, 6U);
  EXPECT_FALSE(facts.capture) << "there is no such check";
  ASSERT_EQ(facts.events.size(), 4U);
  EXPECT_EQ(facts.events[0].step, 2U);
  EXPECT_EQ(facts.events[0].kind, EventKind::kContact);
  EXPECT_EQ(facts.events[1].step, 4U);
  EXPECT_EQ(facts.events[1].text, "body.scale: 1 -> 2");
  EXPECT_EQ(facts.events[2].step, 5U);
  EXPECT_EQ(facts.events[2].text, "body.scale: 2 -> 3 (by hand)");
  EXPECT_EQ(facts.events[3].step, 5U) << "of the last world only what was before it";
}

TEST(WorldAccount, TellsNothingOfAStepThatTheAuthorityHasNotFinished) {
  const config::ExpandedScenario scenario;
  const sim::EngineSpec spec = growing();
  WorldAccount account(scenario, spec);
  for (std::uint64_t step = 0; step < 4; ++step) account.take(world_of(step), {});
  account.take(world_of(4, {{RobotId(1), 2.0}}), {});
  EXPECT_TRUE(account.facts().events.empty());
  account.take(world_of(5), {});
  EXPECT_EQ(account.facts().events.size(), 1U);
}

TEST(WorldAccount, BeginsAnewBehindStepsThatItHasNotSeen) {
  const config::ExpandedScenario scenario;
  const sim::EngineSpec spec = growing();
  WorldAccount account(scenario, spec);
  account.take(world_of(7), touched_before(7));
  account.take(world_of(8), touched_before(8));
  WorldFacts facts = account.facts();
  EXPECT_EQ(facts.first_step, 7U);
  ASSERT_EQ(facts.events.size(), 1U);
  EXPECT_EQ(facts.events[0].step, 7U);
  account.take(world_of(12), touched_before(12));
  facts = account.facts();
  EXPECT_EQ(facts.first_step, 12U);
  EXPECT_EQ(facts.next_step, 12U);
  EXPECT_TRUE(facts.events.empty());
}

}  // namespace
}  // namespace rave::runtime::testing
