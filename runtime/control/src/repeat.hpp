// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace rave::control {

/// When a message that needs an answer is sent. It may be lost before its receiver has been
/// discovered, so it is sent at once, then again after 50 ms, and after doubled times up to 500 ms.
class Repeat {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool due(Clock::time_point now) const noexcept { return now >= next_; }
  /// When it is due.
  [[nodiscard]] Clock::time_point next() const noexcept { return next_; }
  void sent(Clock::time_point now) noexcept {
    next_ = now + wait_;
    wait_ = std::min(2 * wait_, kLongest);
  }

 private:
  static constexpr std::chrono::milliseconds kLongest{500};
  Clock::time_point next_{};  ///< At first, the past.
  std::chrono::milliseconds wait_{50};
};

}  // namespace rave::control
