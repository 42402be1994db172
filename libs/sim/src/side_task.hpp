// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <thread>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/base/thread.hpp"

namespace rave::sim {

/// Something that is done in a thread of its own, or later by the caller that asks for its result.
/// Belongs to one thread. Its end waits for what was begun, unless that was left alone.
class SideTask {
 public:
  SideTask() = default;

  /// In a thread; where the system grants none, later.
  template <class Work>
  [[nodiscard]] static SideTask in_thread(Work&& work) {
    SideTask task;
    // Shared with the thread, and still here if there is none.
    const auto packaged = std::make_shared<std::packaged_task<Status()>>(std::forward<Work>(work));
    task.result_ = packaged->get_future();
    if (!start_thread(task.thread_, "a side task", [packaged] { (*packaged)(); })) {
      return later([packaged, result = std::move(task.result_)]() mutable {
        (*packaged)();
        return result.get();
      });
    }
    return task;
  }
  template <class Work>
  [[nodiscard]] static SideTask later(Work&& work) {
    SideTask task;
    task.result_ = std::async(std::launch::deferred, std::forward<Work>(work));
    return task;
  }

  /// Whether get() and wait() have nothing to wait for but what they do themselves; also without a
  /// task.
  [[nodiscard]] bool ready_by(std::chrono::steady_clock::time_point when) const {
    return !result_.valid() || result_.wait_until(when) != std::future_status::timeout;
  }
  [[nodiscard]] bool ready() const {
    return !result_.valid() ||
           result_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
  }
  /// Until it is done; nothing without a task.
  void wait() const {
    if (result_.valid()) result_.wait();
  }
  /// Waits; once.
  [[nodiscard]] Status get() { return result_.get(); }
  /// No thread waits for it any more. Whatever it uses must stay.
  void leave_alone() {
    if (thread_.joinable()) thread_.detach();
  }

 private:
  std::future<Status> result_;
  std::jthread thread_;
};

}  // namespace rave::sim
