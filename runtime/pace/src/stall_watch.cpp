// SPDX-License-Identifier: Apache-2.0
#include "rave/pace/stall_watch.hpp"

#include "rave/base/thread.hpp"

namespace rave::runtime {
namespace {

constexpr auto kLook = std::chrono::milliseconds(250);
constexpr auto kPatience = std::chrono::seconds(1);

}  // namespace

StallWatch::StallWatch(LogSink* log) : log_(log) {
  if (log_ == nullptr) return;
  // A run continues without it.
  const Status started = start_thread(thread_, "the watch over steps", [this] { watch(); });
  if (!started) {
    log_->warn("run", "{}; a step that does not end will not be reported", started.error().message);
  }
}

StallWatch::~StallWatch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void StallWatch::step_begins(std::uint64_t step) {
  const std::lock_guard lock(mutex_);
  step_ = step;
  since_ = std::chrono::steady_clock::now();
}

void StallWatch::step_ends() {
  const std::lock_guard lock(mutex_);
  since_.reset();
}

void StallWatch::watch() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    // A thread of its own, because the thread of the run is the one that hangs. It looks
    // periodically, so a step need not wake it.
    wake_.wait_for(lock, kLook);
    if (ending_ || !since_ || told_ == step_) continue;
    if (std::chrono::steady_clock::now() - *since_ < kPatience) continue;
    // Once per step: a driver that never returns is one line in the log.
    told_ = step_;
    log_->warn("run",
               "step {} has not ended for 1 s: a driver or program does not return; `isolate: "
               "true` runs a program in its own process, which can be stopped",
               step_);
  }
}

}  // namespace rave::runtime
