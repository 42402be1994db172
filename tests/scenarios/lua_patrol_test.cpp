// SPDX-License-Identifier: Apache-2.0
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class LuaPatrol : public ScenarioTest {
 protected:
  std::uint64_t hash_of(const config::ExpandedScenario& scenario) {
    const World world = make_world(scenario);
    if (!world.engine) return 0;
    world.run_until(40);
    return world.engine->hash().value();
  }
};

TEST_F(LuaPatrol, GoesItsRoundsAndTouchesNothing) {
  const auto outcome = run(load("lua-patrol"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold) << outcome.summary;
}

TEST_F(LuaPatrol, ThreadsAndProcessesOfItsOwnDoNotMatter) {
  auto scenario = load("lua-patrol");
  const std::uint64_t alone = hash_of(scenario);
  EXPECT_NE(alone, 0U);
  scenario.scenario.threads = 2;
  EXPECT_EQ(hash_of(scenario), alone);
  for (config::RobotGroup& group : scenario.groups) group.robot.program->isolate = true;
  EXPECT_EQ(hash_of(scenario), alone);
}

TEST_F(LuaPatrol, AMissingFileIsAnErrorWithItsPath) {
  auto scenario = load("lua-patrol");
  for (config::RobotGroup& group : scenario.groups) {
    group.robot.program->params.set("file", codec::RawNode::text("nowhere.lua"));
  }
  const auto catalogue = plugins();
  auto built = runtime::build(scenario, *catalogue, options());
  ASSERT_TRUE(built) << built.error().text();
  const auto engine = sim::Engine::create(std::move(built->spec));
  ASSERT_FALSE(engine);
  EXPECT_NE(engine.error().text().find("robots/nowhere.lua"), std::string::npos)
      << engine.error().text();
}

}  // namespace
}  // namespace rave::tests
