// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "rave/base/token_bucket.hpp"

namespace rave::gui_server {

/// A thread for what must not hold up that of the server: disks and passwords. Few calls wait; more
/// are refused, so that they cannot pile up. Destruction drops those that have not begun.
class SlowWork {
 public:
  SlowWork() = default;
  SlowWork(const SlowWork&) = delete;
  SlowWork& operator=(const SlowWork&) = delete;
  ~SlowWork() { stop(); }

  /// `queue`: whose call it is, such as the network of a person who signs in; empty: that of the
  /// server. Those of the server come first. The other queues take turns, and after some calls at
  /// once they slow down, so that guessers of passwords neither keep a core busy nor others out.
  /// The first call starts the thread. False: too many wait, or the system grants no thread; the
  /// next call tries again. Any thread.
  [[nodiscard]] bool post(std::function<void()> call, const std::string& queue = {});
  /// Ends the thread after the call that it is at. Idempotent.
  void stop();

 private:
  using Calls = std::deque<std::function<void()>>;
  // Hashing a password takes about a tenth of a second.
  static constexpr double kCallsAtOnce = 20;
  static constexpr double kCallsPerSecond = 3;

  void run();
  /// The next call, for which it may wait; null: it ends. `lock` is held.
  [[nodiscard]] std::function<void()> next(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable wake_;
  Calls own_;
  std::map<std::string, Calls> queues_;  ///< Without empty ones.
  std::string last_;                     ///< The queue that had its turn.
  std::size_t waiting_ = 0;              ///< In `queues_`.
  TokenBucket pace_{kCallsPerSecond, kCallsAtOnce};
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace rave::gui_server
