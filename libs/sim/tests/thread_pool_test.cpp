// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/thread_pool.hpp"

#include <gtest/gtest.h>

namespace rave::sim {
namespace {

TEST(ThreadPool, RunsEveryBlockOnceInManyRounds) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    ThreadPool pool(threads);
    ASSERT_EQ(pool.threads(), threads);
    // Not atomic on purpose: each block is one thread's own, and each round sees the last one.
    std::vector<int> runs(97);
    std::vector<std::size_t> by_worker(threads);
    std::size_t expected = 0;
    for (std::size_t round = 0; round < 500; ++round) {
      const std::size_t blocks = round % (runs.size() + 1);
      expected += blocks;
      std::vector<int> before = runs;
      pool.for_each_block(blocks, [&](std::size_t block, unsigned worker) {
        ++runs[block];
        ++by_worker[worker];
      });
      for (std::size_t b = 0; b < runs.size(); ++b) {
        ASSERT_EQ(runs[b], before[b] + (b < blocks ? 1 : 0)) << "round " << round;
      }
    }
    std::size_t done = 0;
    for (const std::size_t count : by_worker) done += count;
    EXPECT_EQ(done, expected);
  }
}

TEST(ThreadPool, ZeroThreadsStillWorkInTheCallersOwn) {
  ThreadPool pool(0);
  EXPECT_EQ(pool.threads(), 1U);
  int runs = 0;
  pool.for_each_block(3, [&](std::size_t, unsigned worker) {
    EXPECT_EQ(worker, 0U);
    ++runs;
  });
  EXPECT_EQ(runs, 3);
}

TEST(ThreadPool, EndsWithoutHavingWorked) {
  for (int i = 0; i < 50; ++i) {
    const ThreadPool pool(4);
  }
}

}  // namespace
}  // namespace rave::sim
