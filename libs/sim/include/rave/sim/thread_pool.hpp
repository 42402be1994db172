// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rave::sim {

/// Threads that share the blocks of one loop at a time. Which thread takes which block is left to
/// chance, so blocks must not depend on one another nor on who runs them. Belongs to one thread,
/// which takes part in the work.
class ThreadPool {
 public:
  /// `threads` in all, the calling one included; at least 1.
  explicit ThreadPool(unsigned threads);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  /// Calls `work(block, worker)` once for each block in [0, blocks) and returns when all are done.
  /// `worker` is in [0, threads): an index into what each thread has of its own. `work` must not
  /// throw.
  void for_each_block(std::size_t blocks, const std::function<void(std::size_t, unsigned)>& work);

  [[nodiscard]] unsigned threads() const noexcept {
    return static_cast<unsigned>(workers_.size()) + 1;
  }

 private:
  void serve(unsigned worker);
  void take_blocks(unsigned worker);

  std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable done_;
  std::uint64_t round_ = 0;
  unsigned busy_ = 0;
  bool ending_ = false;
  const std::function<void(std::size_t, unsigned)>* work_ = nullptr;
  std::size_t blocks_ = 0;
  std::atomic<std::size_t> next_{0};
  std::vector<std::thread> workers_;
};

}  // namespace rave::sim
