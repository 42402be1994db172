// SPDX-License-Identifier: Apache-2.0
// Threads for the loops of a step. Each has the same share of the blocks in each loop, so that
// their data stay in the cache of its processor; those who are done early help the others.
#include "rave/sim/thread_pool.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace rave::sim {
namespace {

using Clock = std::chrono::steady_clock;

/// How long an idle thread looks for work: longer than what lies between two loops of a step, and
/// no longer than waking it would take.
constexpr auto kLook = std::chrono::microseconds(50);

/// Leaves the processor's resources to its other thread for a moment.
void pause_processor() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#else
  std::this_thread::yield();
#endif
}

/// Waits for `reached` without sleeping; false if it takes too long.
template <class Condition>
bool look_for(const Condition& reached) noexcept {
  constexpr int kLooks = 16;  // between two looks at the clock
  const auto end = Clock::now() + kLook;
  do {
    for (int i = 0; i < kLooks; ++i) {
      if (reached()) return true;
      pause_processor();
    }
  } while (Clock::now() < end);
  return false;
}

std::int64_t nanoseconds_since(Clock::time_point begin) {
  return std::chrono::nanoseconds(Clock::now() - begin).count();
}

}  // namespace

ThreadPool::ThreadPool(unsigned threads, bool always)
    : always_(always),
      may_look_(threads <= std::thread::hardware_concurrency()),
      shares_(std::make_unique<Share[]>(std::max(threads, 1U))) {
  for (unsigned worker = 1; worker < std::max(threads, 1U); ++worker) {
    try {
      workers_.emplace_back([this, worker] { serve(worker); });
    } catch (const std::system_error&) {
      return;  // threads() says how many there are
    }
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
  // A guess that may be outdated by now: it decides only whether sharing is likely to pay.
  const bool awake = asleep_.load(std::memory_order_relaxed) == 0;
  const bool worth = awake ? effort.is_worth_sharing() : effort.is_worth_waking();
  if (blocks < 2 || !(always_ || worth)) {
    const auto begin = Clock::now();
    for (std::size_t block = 0; block < blocks; ++block) work(block, 0);
    effort.work_ns_ = nanoseconds_since(begin);
    return;
  }
  share(blocks, work);
  effort.work_ns_ = work_ns_.load(std::memory_order_relaxed);
}

void ThreadPool::share(std::size_t blocks, const std::function<void(std::size_t, unsigned)>& work) {
  // No thread reads these before the next round begins: all are done with the last one.
  work_ = &work;
  const std::size_t workers = threads();
  for (std::size_t worker = 0; worker < workers; ++worker) {
    // The same cut for the same number of blocks, so each worker finds the data of its blocks in
    // its cache.
    shares_[worker].next.store(blocks * worker / workers, std::memory_order_relaxed);
    shares_[worker].end = blocks * (worker + 1) / workers;
  }
  work_ns_.store(0, std::memory_order_relaxed);
  busy_.store(static_cast<unsigned>(workers_.size()), std::memory_order_relaxed);
  bool wake = false;
  {
    const std::lock_guard lock(mutex_);
    // Releases work_, the shares and the counters to the workers. Under the mutex, so that no
    // worker goes to sleep between its look at the round and the notification.
    round_.fetch_add(1, std::memory_order_release);
    wake = asleep_.load(std::memory_order_relaxed) > 0;
  }
  if (wake) wake_.notify_all();
  take_blocks(0);
  const auto all_done = [this] { return busy_.load(std::memory_order_acquire) == 0; };
  // The acquire of busy_ makes visible what the workers wrote.
  if (may_look_ && look_for(all_done)) return;
  std::unique_lock lock(mutex_);
  done_.wait(lock, all_done);
}

void ThreadPool::take_blocks(unsigned worker) {
  const auto begin = Clock::now();
  // Who is done with its own helps the others.
  const unsigned workers = threads();
  for (unsigned k = 0; k < workers; ++k) {
    Share& share = shares_[(worker + k) % workers];
    while (true) {
      // Counts beyond the end when there is none left, at most once per worker; share() resets it.
      const std::size_t block = share.next.fetch_add(1, std::memory_order_relaxed);
      if (block >= share.end) break;
      (*work_)(block, worker);
    }
  }
  work_ns_.fetch_add(nanoseconds_since(begin), std::memory_order_relaxed);
}

bool ThreadPool::look_for_round(std::uint64_t seen) const noexcept {
  return may_look_ &&
         look_for([this, seen] { return round_.load(std::memory_order_acquire) != seen; });
}

void ThreadPool::serve(unsigned worker) {
  std::uint64_t seen = 0;
  while (true) {
    if (!look_for_round(seen)) {
      std::unique_lock lock(mutex_);
      asleep_.fetch_add(1, std::memory_order_relaxed);
      wake_.wait(lock, [&] { return ending_ || round_.load(std::memory_order_acquire) != seen; });
      asleep_.fetch_sub(1, std::memory_order_relaxed);
      if (ending_) return;
    }
    ++seen;  // no round begins before all have done the last one
    take_blocks(worker);
    // The last one wakes the caller. The lock is taken so that the caller cannot miss it between
    // its look at busy_ and its sleep.
    if (busy_.fetch_sub(1, std::memory_order_acq_rel) > 1) continue;
    const std::lock_guard lock(mutex_);
    done_.notify_one();
  }
}

}  // namespace rave::sim
