// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rave/robot/actuator.hpp"
#include "rave/robot/sample_queue.hpp"
#include "rave/world/body.hpp"

/// For tests of what guards real robots in live runs.
namespace rave::sim::testing {

/// A clock on the wall that the test sets.
class HandClock final : public RunClock {
 public:
  [[nodiscard]] SimTime now() const noexcept override { return {now_ns_}; }
  [[nodiscard]] std::chrono::steady_clock::time_point wall_time_of(
      SimTime) const noexcept override {
    return {};
  }
  void set(double now_s) { now_ns_ = from_seconds(now_s).ns; }
  void advance(double by_s) { now_ns_ += from_seconds(by_s).ns; }

 private:
  std::atomic<std::int64_t> now_ns_ = 0;
};

/// How long a test waits for something that has to come.
inline constexpr std::chrono::seconds kPatience{60};

/// An actuator that keeps what it is told, and by whom; its instance is this object. Can be made to
/// hang, and to call `on_write` with each command.
class Hand {
 public:
  static const HardwareActuatorOps& ops() {
    static const HardwareActuatorOps kOps = [] {
      HardwareActuatorOps made;
      made.write = [](void* instance, const Command* command, std::int64_t, ErrorText* error) {
        return static_cast<Hand*>(instance)->write(*command, error);
      };
      return made;
    }();
    return kOps;
  }

  /// Until it was told so, or told this as the last. False: it never was.
  [[nodiscard]] bool await(const Command& command) {
    std::unique_lock lock(mutex_);
    return told_so_.wait_for(lock, kPatience,
                             [&] { return !told_.empty() && told_.back() == command; });
  }
  [[nodiscard]] bool await_count(std::size_t count) {
    std::unique_lock lock(mutex_);
    return told_so_.wait_for(lock, kPatience, [&] { return told_.size() >= count; });
  }
  /// Until somebody hangs in write().
  [[nodiscard]] bool await_hanging() {
    std::unique_lock lock(mutex_);
    return told_so_.wait_for(lock, kPatience, [&] { return is_hanging_; });
  }
  void hang() {
    const std::lock_guard lock(mutex_);
    hangs_ = true;
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    hangs_ = false;
    let_go_.notify_all();
  }
  void fail_with(const char* text) {
    const std::lock_guard lock(mutex_);
    failure_ = text;
  }
  [[nodiscard]] std::vector<Command> told() {
    const std::lock_guard lock(mutex_);
    return told_;
  }
  [[nodiscard]] std::vector<std::thread::id> writers() {
    const std::lock_guard lock(mutex_);
    return writers_;
  }

  std::function<void(const Command&)> on_write;  ///< Set before anybody writes.

  int write(const Command& command, ErrorText* error) {
    if (on_write) on_write(command);
    std::unique_lock lock(mutex_);
    told_.push_back(command);
    const auto self = std::this_thread::get_id();
    if (writers_.empty() || writers_.back() != self) writers_.push_back(self);
    is_hanging_ = hangs_;
    told_so_.notify_all();
    let_go_.wait(lock, [&] { return !hangs_; });
    is_hanging_ = false;
    if (failure_.empty()) return 0;
    error->set(failure_);
    return 1;
  }

 private:
  std::mutex mutex_;
  std::condition_variable told_so_;
  std::condition_variable let_go_;
  std::vector<Command> told_;
  std::vector<std::thread::id> writers_;  ///< Each time it is another.
  bool hangs_ = false;
  bool is_hanging_ = false;
  std::string failure_;
};

}  // namespace rave::sim::testing
