// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

#include "rave/base/log.hpp"
#include "rave/robot/sample_queue.hpp"

namespace rave::sim {

/// The log and the clock of a run as drivers get them, whose threads may be there for longer than
/// these: once cut, nothing reaches them any more.
class LogOutlet final : public LogSink {
 public:
  /// `to` is not owned and may be null.
  explicit LogOutlet(LogSink* to) : to_(to) {}
  void write(LogLevel level, std::string_view source, std::string_view message) override {
    const std::lock_guard lock(mutex_);
    if (to_ != nullptr) to_->write(level, source, message);
  }
  void cut() {
    const std::lock_guard lock(mutex_);
    to_ = nullptr;
  }

 private:
  std::mutex mutex_;
  LogSink* to_;
};

class ClockOutlet final : public RunClock {
 public:
  /// `to` is not owned.
  explicit ClockOutlet(const RunClock& to) : to_(&to) {}
  [[nodiscard]] SimTime now() const noexcept override {
    const std::lock_guard lock(mutex_);
    if (to_ != nullptr) last_ = to_->now();
    return last_;
  }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime t) const noexcept override {
    const std::lock_guard lock(mutex_);
    // Once cut it stands, as of a run that is paused.
    return to_ != nullptr ? to_->wall_time_of(t) : std::chrono::steady_clock::time_point::max();
  }
  void cut() noexcept {
    const std::lock_guard lock(mutex_);
    to_ = nullptr;
  }

 private:
  mutable std::mutex mutex_;
  mutable SimTime last_;
  const RunClock* to_;
};

}  // namespace rave::sim
