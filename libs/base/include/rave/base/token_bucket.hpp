// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace rave {

/// Limits the rate of one kind of action: `burst` at once, then `per_s`. One owner thread.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;
  TokenBucket(double per_s, double burst) : per_s_(per_s), burst_(burst), tokens_(burst) {}

  /// Takes a token. False: there is none.
  [[nodiscard]] bool take(Clock::time_point now) {
    tokens_ = tokens(now);
    at_ = now;
    if (tokens_ < 1) return false;
    tokens_ -= 1;
    return true;
  }
  /// Number of tokens, 0 to `burst`: refilled at a constant rate, computed when it is asked.
  [[nodiscard]] double tokens(Clock::time_point now) const {
    const double gone_s = std::chrono::duration<double>(now - at_).count();
    return std::min(burst_, tokens_ + per_s_ * std::max(gone_s, 0.0));
  }

 private:
  double per_s_;
  double burst_;
  double tokens_;
  Clock::time_point at_{};
};

}  // namespace rave
