// SPDX-License-Identifier: Apache-2.0
// Same scenario and seed, same hash. The golden values hold for every build type and processor:
// ctest runs this program once more with the C library's processor features hidden.
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

constexpr double kSpan_s = 20;
/// The hash of the first twenty seconds of `mixed-reality`. It changes with the scenario, its
/// robots and their drivers; then look why, and write the new one here.
constexpr std::uint64_t kGolden = 6282146545155268263ULL;
/// The same of `flock`, whose robots talk.
constexpr std::uint64_t kGoldenFlock = 2383855366677754669ULL;

class Determinism : public ScenarioTest {
 protected:
  std::uint64_t hash_of(const config::ExpandedScenario& scenario) {
    const auto world = make_world(scenario);
    if (!world.engine) return 0;
    world.run_until(kSpan_s);
    return world.engine->hash().value();
  }
};

TEST_F(Determinism, MixedRealityHasItsGoldenHash) {
  EXPECT_EQ(hash_of(load("mixed-reality")), kGolden);
}

TEST_F(Determinism, FlockHasItsGoldenHash) { EXPECT_EQ(hash_of(load("flock")), kGoldenFlock); }

TEST_F(Determinism, TheNumberOfThreadsDoesNotMatter) {
  for (const int threads : {2, 3}) {
    auto scenario = load("mixed-reality");
    scenario.scenario.threads = threads;
    EXPECT_EQ(hash_of(scenario), kGolden) << threads << " threads";
  }
}

TEST_F(Determinism, NorForAHybridOfARecordedLaser) {
  auto scenario = load("hybrid-laser");
  const std::uint64_t hash = hash_of(scenario);
  EXPECT_NE(hash, 0U);
  scenario.scenario.threads = 3;
  EXPECT_EQ(hash_of(scenario), hash);
}

TEST_F(Determinism, ProgramsInProcessesOfTheirOwnDecideTheSame) {
  auto scenario = load("mixed-reality");
  for (config::RobotGroup& group : scenario.groups) {
    if (group.robot.program) group.robot.program->isolate = true;
  }
  EXPECT_EQ(hash_of(scenario), kGolden);
}

TEST_F(Determinism, TenExactResetsInARow) {
  const auto world = make_world(load("mixed-reality"));
  ASSERT_TRUE(world.engine);
  world.run_until(2);
  const RunHash first = world.engine->hash();
  for (int i = 0; i < 10; ++i) {
    const Status status = world.engine->reset();
    ASSERT_TRUE(status) << status.error().text();
    EXPECT_EQ(world.engine->steps_done(), 0U);
    world.run_until(2);
    EXPECT_EQ(world.engine->hash(), first) << "reset " << i;
  }
}

TEST_F(Determinism, OneBitOfOnePerceptChangesTheHash) {
  const auto world = make_world(load("mixed-reality"));
  ASSERT_TRUE(world.engine);
  world.run_until(2);
  const RunHash first = world.engine->hash();
  ASSERT_TRUE(world.engine->reset());
  world.run_until(1.99);
  const std::uint32_t robot = robot_named(*world.engine, "walker-3");
  world.engine->flip_percept_bit(RobotId(robot), sensor_named(*world.engine, robot, "laser"));
  world.run_until(2);
  EXPECT_NE(world.engine->hash(), first);
}

TEST_F(Determinism, AnotherSeedGivesAnotherRun) {
  auto scenario = load("mixed-reality");
  scenario.scenario.seed = 2;
  EXPECT_NE(hash_of(scenario), kGolden);
}

}  // namespace
}  // namespace rave::tests
