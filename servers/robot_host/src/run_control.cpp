// SPDX-License-Identifier: Apache-2.0
#include "rave/robot_host/run_control.hpp"

#include <chrono>

namespace rave::robot_host {

void RunControl::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
}

void RunControl::resume() {
  {
    const std::lock_guard lock(mutex_);
    paused_ = false;
    steps_ = 0;
  }
  changed_.notify_all();
}

void RunControl::step(std::uint64_t count) {
  {
    const std::lock_guard lock(mutex_);
    steps_ += count;
  }
  changed_.notify_all();
}

bool RunControl::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

bool RunControl::wait_for_turn() {
  // A signal handler cannot notify, so a held run looks up by itself now and then.
  constexpr auto kLook = std::chrono::milliseconds(50);
  std::unique_lock lock(mutex_);
  while (!stopping()) {
    if (!paused_) return true;
    if (steps_ > 0) {
      --steps_;
      return true;
    }
    changed_.wait_for(lock, kLook);
  }
  return false;
}

}  // namespace rave::robot_host
