// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace rave::bus {

/// A token bucket: what may be taken now. It is full at first and refills with time. One owner
/// thread.
class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  Budget(double per_second, double most) noexcept
      : per_second_(per_second), most_(most), left_(most) {}

  /// Takes one, if there is one.
  [[nodiscard]] bool take(Clock::time_point now) noexcept {
    const double since_s = std::chrono::duration<double>(now - filled_).count();
    left_ = std::min(most_, left_ + std::max(0.0, since_s) * per_second_);
    filled_ = now;
    if (left_ < 1) return false;
    left_ -= 1;
    return true;
  }

 private:
  double per_second_;
  double most_;
  double left_;
  Clock::time_point filled_{};
};

}  // namespace rave::bus
