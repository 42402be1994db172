// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/thread_pool.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <thread>

#include "rave/sim/engine.hpp"

namespace rave::sim {
namespace {

using namespace std::chrono_literals;

void wait(std::chrono::nanoseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) {
  }
}

TEST(ThreadPool, RunsEveryBlockOnceInManyRounds) {
  for (const unsigned threads : {1U, 2U, 5U}) {
    ThreadPool pool(threads);
    ASSERT_EQ(pool.threads(), threads);
    // Not atomic on purpose: each block is one thread's own, and each round sees the last one.
    std::vector<int> runs(97);
    std::vector<std::size_t> by_worker(threads);
    std::size_t expected = 0;
    ThreadPool::Effort effort;
    for (std::size_t round = 0; round < 500; ++round) {
      const std::size_t blocks = round % (runs.size() + 1);
      expected += blocks;
      std::vector<int> before = runs;
      pool.for_each_block(blocks, effort, [&](std::size_t block, unsigned worker) {
        if (round % 3 == 0) wait(20us);
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
  ThreadPool::Effort effort;
  pool.for_each_block(3, effort, [&](std::size_t, unsigned worker) {
    EXPECT_EQ(worker, 0U);
    ++runs;
  });
  EXPECT_EQ(runs, 3);
}

TEST(ThreadPool, SharesALoopOnlyWhenItIsLong) {
  ThreadPool pool(2);
  ThreadPool::Effort effort;
  const auto run = [&](std::chrono::nanoseconds each) {
    std::set<unsigned> who[4];
    pool.for_each_block(4, effort, [&](std::size_t block, unsigned worker) {
      wait(each);
      who[block].insert(worker);
    });
    std::set<unsigned> all;
    for (const auto& one : who) all.insert(one.begin(), one.end());
    return all;
  };
  // Nothing is known of the first round; it tells that the next ones are worth sharing.
  EXPECT_EQ(run(5ms), std::set<unsigned>{0});
  EXPECT_TRUE(effort.is_worth_waking());
  EXPECT_EQ(run(50ms), (std::set<unsigned>{0, 1}));
}

TEST(ThreadPool, SharesEveryLoopIfItIsToldTo) {
  ThreadPool pool(2, true);
  ThreadPool::Effort effort;
  for (int round = 0; round < 20; ++round) {
    // Each block ends when the other has begun, so one thread alone would never get to the second.
    std::atomic<int> begun = 0;
    std::atomic<int> met = 0;
    pool.for_each_block(2, effort, [&](std::size_t, unsigned) {
      ++begun;
      const auto patience = std::chrono::steady_clock::now() + 20s;
      while (begun < 2 && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
      if (begun == 2) ++met;
    });
    ASSERT_EQ(met, 2) << "round " << round;
  }
}

TEST(ThreadPool, EndsWithoutHavingWorked) {
  for (int i = 0; i < 50; ++i) {
    const ThreadPool pool(4);
  }
}

// Sanitizers need more of the address space than this leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/// In a process that has no room for the stacks of 1024 threads.
[[noreturn]] void ask_for_too_many_threads() {
  constexpr rlim_t kRoom = rlim_t{1} << 30;
  const rlimit limit{kRoom, kRoom};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) std::exit(2);
  {
    ThreadPool pool(1024);
    if (pool.threads() >= 1024) std::exit(3);
    std::atomic<int> done = 0;
    ThreadPool::Effort effort;
    pool.for_each_block(2000, effort, [&](std::size_t, unsigned) { ++done; });
    if (done != 2000) std::exit(4);
  }
  EngineSpec spec;
  spec.threads = 1024;
  const auto engine = Engine::create(std::move(spec));
  if (engine) std::exit(5);
  std::fprintf(stderr, "%s\n", engine.error().text().c_str());
  std::exit(0);
}

TEST(ThreadPool, FewerThreadsThanAskedForAreAnErrorAndNoCrash) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_for_too_many_threads(), ::testing::ExitedWithCode(0),
              "the system grants only [0-9]+ of 1024 threads");
}

#endif

}  // namespace
}  // namespace rave::sim
