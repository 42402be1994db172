// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace rave::robot_host {

/// The handle on a run while it goes: pause, single steps, end. May be used from any thread; stop()
/// also from a signal handler. Outlives the run.
class RunControl {
 public:
  /// Ends the run before its next step; its results are written. Async-signal-safe.
  void stop() noexcept { stop_.store(true); }
  /// Holds the run before its next step. A live run cannot be held: the world outside goes on.
  void pause();
  /// Lets a paused run go on.
  void resume();
  /// Does `count` steps of a paused run, which then is paused again.
  void step(std::uint64_t count = 1);

  [[nodiscard]] bool stopping() const noexcept { return stop_.load(); }
  [[nodiscard]] bool paused() const;

  /// For the run: waits until a step may be done; false: the run is to end.
  bool wait_for_turn();

 private:
  std::atomic<bool> stop_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool paused_ = false;
  std::uint64_t steps_ = 0;  ///< Single steps still to be done.
};

}  // namespace rave::robot_host
