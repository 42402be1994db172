// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <string>
#include <string_view>

#include "rave/base/log.hpp"
#include "rave/bus/config.hpp"

namespace rave::manager {

/// Where no other test of this machine is heard.
inline bus::BusConfig own_corner() {
  std::random_device chance;
  bus::BusConfig config;
  config.participant = "manager";
  config.run = bus::RunId::random();
  config.domain = 1 + chance() % 90;
  config.tag = fmt::format("manager-test-{}-{}", ::getpid(), chance());
  return config;
}

/// Keeps what it is told, by any thread.
class Lines final : public LogSink {
 public:
  void write(LogLevel, std::string_view, std::string_view message) override {
    const std::scoped_lock lock(mutex_);
    said_ += std::string(message) + '\n';
    said_more_.notify_all();
  }
  /// Until something more is said, or for so long.
  void wait(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    said_more_.wait_for(lock, longest);
  }
  [[nodiscard]] std::string said() const {
    const std::scoped_lock lock(mutex_);
    return said_;
  }
  [[nodiscard]] bool has(std::string_view words) const {
    return said().find(words) != std::string::npos;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable said_more_;
  std::string said_;
};

}  // namespace rave::manager
