// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace rave::sim {

/// A pool of threads for one loop at a time. Threads take blocks in no fixed order, so blocks must
/// not depend on each other or on the thread. Belongs to one thread, which takes part in the work.
/// Idle threads spin briefly before they sleep, because the loops of a step follow each other
/// closely.
class ThreadPool {
 public:
  /// `threads`: total number, the calling one included; at least 1; fewer if the system refuses.
  /// `always`: distribute every loop with two or more blocks, even if that is slower.
  explicit ThreadPool(unsigned threads, bool always = false);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  /// The measured cost of a loop, kept by the caller between its executions. A loop cheaper than
  /// the cost of distribution runs in the calling thread; results do not depend on this.
  class Effort {
   public:
    [[nodiscard]] bool is_worth_waking() const noexcept { return work_ns_ > kWakeWorthNs; }
    /// Like is_worth_waking(), if no thread is asleep.
    [[nodiscard]] bool is_worth_sharing() const noexcept { return work_ns_ > kShareWorthNs; }

   private:
    friend class ThreadPool;
    /// To wake a sleeping thread and wait for its end costs 10 to 100 us, so a loop must take
    /// several times that. A spinning thread reacts much faster.
    static constexpr std::int64_t kWakeWorthNs = 200'000;
    static constexpr std::int64_t kShareWorthNs = 20'000;
    std::int64_t work_ns_ = 0;
  };

  /// Calls `work(block, worker)` once for each block in [0, blocks) and returns when all are done.
  /// `worker` in [0, threads) indexes per-thread data. `work` must not throw. `effort` receives the
  /// total time of all threads.
  void for_each_block(std::size_t blocks, Effort& effort,
                      const std::function<void(std::size_t, unsigned)>& work);

  [[nodiscard]] unsigned threads() const noexcept {
    return static_cast<unsigned>(workers_.size()) + 1;
  }

 private:
  /// The blocks assigned to one worker: the same in each loop, so that their data stays in its
  /// processor's cache. Aligned to cache lines of its own, because other workers count in theirs.
  struct alignas(128) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  void serve(unsigned worker);
  void share(std::size_t blocks, const std::function<void(std::size_t, unsigned)>& work);
  void take_blocks(unsigned worker);
  /// Spins for the next round; false if none begins for a while.
  [[nodiscard]] bool look_for_round(std::uint64_t seen) const noexcept;

  const bool always_;
  const bool may_look_;  ///< There is a processor for each thread, so spinning is allowed.
  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::atomic<std::uint64_t> round_{0};  ///< Changed under mutex_.
  std::atomic<unsigned> busy_{0};
  std::atomic<unsigned> asleep_{0};  ///< Changed under mutex_.
  bool ending_ = false;              ///< Guarded by mutex_.
  const std::function<void(std::size_t, unsigned)>* work_ = nullptr;
  std::unique_ptr<Share[]> shares_;  ///< By worker.
  std::atomic<std::int64_t> work_ns_{0};
  std::vector<std::thread> workers_;
};

}  // namespace rave::sim
