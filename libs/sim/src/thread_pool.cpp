// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/thread_pool.hpp"

#include <algorithm>
#include <chrono>

namespace rave::sim {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t nanoseconds_since(Clock::time_point begin) {
  return std::chrono::nanoseconds(Clock::now() - begin).count();
}

}  // namespace

ThreadPool::ThreadPool(unsigned threads, bool always) : always_(always) {
  for (unsigned worker = 1; worker < std::max(threads, 1U); ++worker) {
    workers_.emplace_back([this, worker] { serve(worker); });
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::for_each_block(std::size_t blocks, Effort& effort,
                                const std::function<void(std::size_t, unsigned)>& work) {
  if (workers_.empty()) {
    for (std::size_t block = 0; block < blocks; ++block) work(block, 0);
    return;
  }
  if (blocks < 2 || !(always_ || effort.is_worth_waking())) {
    const auto begin = Clock::now();
    for (std::size_t block = 0; block < blocks; ++block) work(block, 0);
    effort.work_ns_ = nanoseconds_since(begin);
    return;
  }
  share(blocks, work);
  effort.work_ns_ = work_ns_.load(std::memory_order_relaxed);
}

void ThreadPool::share(std::size_t blocks, const std::function<void(std::size_t, unsigned)>& work) {
  {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    blocks_ = blocks;
    next_.store(0, std::memory_order_relaxed);
    work_ns_.store(0, std::memory_order_relaxed);
    busy_ = static_cast<unsigned>(workers_.size());
    ++round_;
  }
  wake_.notify_all();
  take_blocks(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void ThreadPool::take_blocks(unsigned worker) {
  const auto begin = Clock::now();
  while (true) {
    const std::size_t block = next_.fetch_add(1, std::memory_order_relaxed);
    if (block >= blocks_) break;
    (*work_)(block, worker);
  }
  work_ns_.fetch_add(nanoseconds_since(begin), std::memory_order_relaxed);
}

void ThreadPool::serve(unsigned worker) {
  std::uint64_t seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return ending_ || round_ != seen; });
      if (ending_) return;
      seen = round_;
    }
    take_blocks(worker);
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace rave::sim
