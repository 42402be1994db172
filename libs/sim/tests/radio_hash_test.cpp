// SPDX-License-Identifier: Apache-2.0
#include "rave/sim_testing/radio_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// More robots than one block, of which messages take some time, with all that chance does.
EngineSpec talkative(unsigned threads, double loss = 0.1) {
  EngineSpec spec;
  spec.threads = threads;
  spec.seed = 5;
  add_robot(spec, talking_type({{"size", 12}, {"count", 2}}, {{"range_m", 4},
                                                              {"sight", 1},
                                                              {"rate", 5000},
                                                              {"queue", 500},
                                                              {"overhead", 4},
                                                              {"delay_s", 0.003},
                                                              {"jitter_s", 0.05},
                                                              {"loss", loss},
                                                              {"messages", 40}}));
  for (int r = 1; r < 150; ++r) {
    const int row = r / 13;
    add_twin(spec, {1.0 * (r % 13), 1.0 * row, 0.1 * r});
  }
  spec.world.obstacles.push_back(box({6.5, 6.5, 0.4}, 6, 0.2));
  return spec;
}

std::uint64_t hash_of(EngineSpec spec) {
  Chatter::log().clear();
  const auto engine = make_engine(std::move(spec));
  run(*engine, 60);
  EXPECT_GT(engine->radio_counts().delivered, 10'000U);
  EXPECT_GT(engine->radio_counts().lost_obstacle, 100U);
  EXPECT_GT(engine->radio_counts().lost_chance, 100U);
  return engine->hash().value();
}

TEST_F(RadioTest, TheHashDoesNotDependOnThreads) {
  const std::uint64_t one = hash_of(talkative(1));
  EXPECT_EQ(hash_of(talkative(2)), one);
  EXPECT_EQ(hash_of(talkative(3)), one);
}

TEST_F(RadioTest, ALossChangesTheHash) {
  EXPECT_NE(hash_of(talkative(1, 0.1)), hash_of(talkative(1, 0.1001)));
}

TEST_F(RadioTest, AResetBeginsTheSameRun) {
  const auto engine = make_engine(talkative(2));
  run(*engine, 30);
  const RunHash first = engine->hash();
  const RadioCounts counts = engine->radio_counts();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(engine->reset());
    run(*engine, 30);
    EXPECT_EQ(engine->hash(), first);
    EXPECT_EQ(engine->radio_counts(), counts);
  }
}

}  // namespace
}  // namespace rave::sim::testing
