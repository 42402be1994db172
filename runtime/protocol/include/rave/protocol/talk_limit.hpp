// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rave::real_time {

/// A token bucket that limits the messages of one robot to other hosts: an allowance per step,
/// which accumulates up to a burst. It is far more than a program sends with usual mailboxes, and
/// protects the time and memory of all others from a robot that floods. Receivers allow
/// `kOnReception` times as much, because messages arrive in bursts. One owner thread.
class TalkLimit {
 public:
  static constexpr std::uint32_t kMessagesPerStep = 64;
  static constexpr std::uint32_t kMessagesAtOnce = 1024;
  static constexpr std::size_t kBytesPerStep = 16'384;
  static constexpr std::size_t kBytesAtOnce = 262'144;
  static constexpr std::uint32_t kOnReception = 2;

  explicit TalkLimit(std::uint32_t times = 1) noexcept : times_(times) {}

  /// Whether a message of this size may pass; if so, it is counted.
  [[nodiscard]] bool take(std::size_t bytes) noexcept {
    if (messages_ == 0 || bytes > bytes_) return false;
    --messages_;
    bytes_ -= bytes;
    return true;
  }
  /// Begins the next step.
  void step() noexcept {
    messages_ = std::min(times_ * kMessagesAtOnce, messages_ + times_ * kMessagesPerStep);
    bytes_ = std::min(times_ * kBytesAtOnce, bytes_ + times_ * kBytesPerStep);
  }
  /// True on the first call only: a robot that exceeds the limit is reported once.
  [[nodiscard]] bool name() noexcept { return !std::exchange(named_, true); }

 private:
  std::uint32_t times_;
  std::uint32_t messages_ = times_ * kMessagesAtOnce;
  std::size_t bytes_ = times_ * kBytesAtOnce;
  bool named_ = false;
};

}  // namespace rave::real_time
