// SPDX-License-Identifier: Apache-2.0
// A program of its own: it counts every allocation of the process.
#include "counted_allocations.hpp"
#include "split_run.hpp"

namespace rave::sim::testing {
namespace {

/// Robots that see, decide and bump into one another, boxes and walls.
EngineSpec crowd(unsigned threads) {
  EngineSpec spec;
  spec.threads = threads;
  spec.step = from_seconds(0.1);
  constexpr double kSide_m = 24;
  for (const double at_m : {-1.0, kSide_m}) {
    spec.world.obstacles.push_back(box({at_m, kSide_m / 2, 0}, 0.1, 30));
    spec.world.obstacles.push_back(box({kSide_m / 2, at_m, 0}, 30, 0.1));
  }
  for (int i = 0; i < 100; ++i) {
    const int row = i / 10;
    spec.world.obstacles.push_back(box({0.6 + 2.4 * (i % 10), 0.6 + 2.4 * row, 0.1 * i}, 0.5, 0.4));
  }
  RobotType type = simulated_type();
  type.sensors.push_back(laser(16, 6, 0.2));
  type.program = program<Roam>();
  add_robot(spec, std::move(type));
  for (std::uint32_t r = 1; r < 400; ++r) {
    const std::uint32_t row = r / 20;
    add_twin(spec, {1.2 * (r % 20), 1.2 * row, 0.1 * (r % 60)});
  }
  return spec;
}

struct Swing {
  std::uint64_t allocations = 0;
  std::size_t contacts = 0;
};

constexpr int kSteps = 300;

/// What kSteps steps of a crowd that is on its way allocate.
Swing swing(unsigned threads) {
  const auto engine = make_engine(crowd(threads));
  for (int k = 0; k < kSteps; ++k) EXPECT_TRUE(engine->step());
  const std::uint64_t before = allocations.load();
  Swing result;
  bool stepped = true;
  for (int k = 0; k < kSteps; ++k) {
    stepped = engine->step().has_value() && stepped;
    result.contacts += engine->events().size();
  }
  result.allocations = allocations.load() - before;
  EXPECT_TRUE(stepped);
  EXPECT_GT(result.contacts, 500U) << "the world is not as busy as it is meant to be";
  return result;
}

TEST(EngineStep, AllocatesNothingInTheSwing) {
  // A list may still grow a few times, when a step has more contacts than any before. On one thread
  // each run has the same lists, so this number is the same each time.
  EXPECT_LE(swing(1).allocations, 8U);
}

TEST(EngineStep, AllocatesNothingInTheSwingOnTwoThreads) {
  // Each thread has lists of its own, and chance says which blocks it takes: a thread that was late
  // for the fullest blocks grows its lists when it first meets them. Once a step would be kSteps.
  EXPECT_LE(swing(2).allocations, kSteps / 10U);
}

/// What kSteps steps of the same crowd on two hosts allocate, all in one.
TEST(EngineStep, AllocatesNothingForRobotsOfSeveralHosts) {
  std::vector<std::uint32_t> host_of(400);
  for (std::uint32_t r = 0; r < host_of.size(); ++r) host_of[r] = r / 7 % 2;
  SplitRun run([] { return crowd(1); }, host_of);
  for (int k = 0; k < kSteps; ++k) ASSERT_TRUE(run.advance());
  const std::uint64_t before = allocations.load();
  bool good = true;
  for (int k = 0; k < kSteps; ++k) good = run.advance() && good;
  EXPECT_TRUE(good);
  // As above, and lists that a host and its report swap learn their size one after the other.
  EXPECT_LE(allocations.load() - before, 16U);
}

}  // namespace
}  // namespace rave::sim::testing
