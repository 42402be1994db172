// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace rave::gui_server {

/// A thread for what must not hold up that of the server: passwords. Few calls wait; more are
/// refused, so that they cannot pile up. Destruction drops those that have not begun.
class SlowWork {
 public:
  SlowWork() = default;
  SlowWork(const SlowWork&) = delete;
  SlowWork& operator=(const SlowWork&) = delete;
  ~SlowWork() { stop(); }

  /// The first call starts the thread. False: too many wait, or the system grants no thread; the
  /// next call tries again. Any thread.
  [[nodiscard]] bool post(std::function<void()> call);
  /// Ends the thread after the call that it is at. Idempotent.
  void stop();

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<std::function<void()>> calls_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace rave::gui_server
