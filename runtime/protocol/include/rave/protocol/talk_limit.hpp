// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace rave::real_time {

/// How much one robot may say to other hosts: so much in each step, and what it did not use of that
/// up to a burst. It is far more than a program says with the usual mailboxes, and keeps one that
/// floods from the time and memory of all others. Whoever receives allows `kOnReception` times as
/// much: what left in order arrives in bunches. One owner thread.
class TalkLimit {
 public:
  static constexpr std::uint32_t kMessagesPerStep = 64;
  static constexpr std::uint32_t kMessagesAtOnce = 1024;
  static constexpr std::size_t kBytesPerStep = 16'384;
  static constexpr std::size_t kBytesAtOnce = 262'144;
  static constexpr std::uint32_t kOnReception = 2;

  explicit TalkLimit(std::uint32_t times = 1) noexcept : times_(times) {}

  /// Whether a message of so many bytes may pass; if so it is counted.
  [[nodiscard]] bool take(std::size_t bytes) noexcept {
    if (messages_ == 0 || bytes > bytes_) return false;
    --messages_;
    bytes_ -= bytes;
    return true;
  }
  /// The next step begins.
  void step() noexcept {
    messages_ = std::min(times_ * kMessagesAtOnce, messages_ + times_ * kMessagesPerStep);
    bytes_ = std::min(times_ * kBytesAtOnce, bytes_ + times_ * kBytesPerStep);
  }
  /// True the first time: somebody has to be told of a robot that exceeds it, once.
  [[nodiscard]] bool name() noexcept { return !std::exchange(named_, true); }

 private:
  std::uint32_t times_;
  std::uint32_t messages_ = times_ * kMessagesAtOnce;
  std::size_t bytes_ = times_ * kBytesAtOnce;
  bool named_ = false;
};

}  // namespace rave::real_time
