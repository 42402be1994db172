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

/// Threads that share the blocks of one loop at a time. Which thread takes which block is left to
/// chance, so blocks must not depend on one another nor on who runs them. Belongs to one thread,
/// which takes part in the work. A thread that has nothing to do keeps looking for more for a
/// moment before it sleeps: the loops of a step follow one another closely.
class ThreadPool {
 public:
  /// `threads` in all, the calling one included; at least 1; as many as the system gives. `always`:
  /// every loop of two blocks and more is shared, also where that costs more than it brings.
  explicit ThreadPool(unsigned threads, bool always = false);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  /// What one loop cost when it ran last, kept by the caller from round to round. A loop that takes
  /// less than having others join does stays with the caller; which threads run it changes nothing.
  class Effort {
   public:
    [[nodiscard]] bool is_worth_waking() const noexcept { return work_ns_ > kWakeWorthNs; }
    /// The same where all threads are awake.
    [[nodiscard]] bool is_worth_sharing() const noexcept { return work_ns_ > kShareWorthNs; }

   private:
    friend class ThreadPool;
    /// Waking a sleeping thread and waiting for its end costs 10 to 100 us, so a loop has to hold
    /// several times that before sharing it pays. One that is awake is told in far less.
    static constexpr std::int64_t kWakeWorthNs = 200'000;
    static constexpr std::int64_t kShareWorthNs = 20'000;
    std::int64_t work_ns_ = 0;
  };

  /// Calls `work(block, worker)` once for each block in [0, blocks) and returns when all are done.
  /// `worker` is in [0, threads): an index into what each thread has of its own. `work` must not
  /// throw. The time that all threads took together is noted in `effort`.
  void for_each_block(std::size_t blocks, Effort& effort,
                      const std::function<void(std::size_t, unsigned)>& work);

  [[nodiscard]] unsigned threads() const noexcept {
    return static_cast<unsigned>(workers_.size()) + 1;
  }

 private:
  /// The blocks that are one worker's in the first place: the same ones in each loop, so that what
  /// belongs to them stays in its processor's cache. On lines of its own, as others count in
  /// theirs.
  struct alignas(128) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };

  void serve(unsigned worker);
  void share(std::size_t blocks, const std::function<void(std::size_t, unsigned)>& work);
  void take_blocks(unsigned worker);
  /// Looks for the next round; false if none comes for a while.
  [[nodiscard]] bool look_for_round(std::uint64_t seen) const noexcept;

  const bool always_;
  const bool may_look_;  ///< There is a processor for each thread.
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
