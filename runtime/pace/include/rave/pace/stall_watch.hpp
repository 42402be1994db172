// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <thread>

#include "rave/base/log.hpp"

namespace rave::runtime {

/// Logs a warning when a step does not end: a driver or program inside this process that never
/// returns cannot be stopped, but the user should know. Has a thread of its own; where
/// the system gives none, it warns once and watches nothing.
class StallWatch {
 public:
  explicit StallWatch(LogSink* log);
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;
  ~StallWatch();

  void step_begins(std::uint64_t step);
  void step_ends();

 private:
  void watch();

  LogSink* log_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ending_ = false;
  std::uint64_t step_ = 0;
  std::uint64_t told_ = UINT64_MAX;
  std::optional<std::chrono::steady_clock::time_point> since_;
  std::thread thread_;
};

}  // namespace rave::runtime
