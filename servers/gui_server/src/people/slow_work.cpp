// SPDX-License-Identifier: Apache-2.0
#include "people/slow_work.hpp"

#include "rave/base/thread.hpp"

namespace rave::gui_server {

namespace {
constexpr std::size_t kMostWaiting = 16;
}

bool SlowWork::post(std::function<void()> call) {
  {
    const std::lock_guard lock(mutex_);
    if (ends_ || calls_.size() >= kMostWaiting) return false;
    if (!thread_.joinable() && !start_thread(thread_, "slow work", [this] { run(); })) return false;
    calls_.push_back(std::move(call));
  }
  wake_.notify_one();
  return true;
}

void SlowWork::stop() {
  std::deque<std::function<void()>> dropped;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    dropped.swap(calls_);
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void SlowWork::run() {
  while (true) {
    std::function<void()> call;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return ends_ || !calls_.empty(); });
      if (ends_) return;
      call = std::move(calls_.front());
      calls_.pop_front();
    }
    call();
  }
}

}  // namespace rave::gui_server
