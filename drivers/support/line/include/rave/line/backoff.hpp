// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace rave::line {

/// The delay before the next attempt to connect to a device. It doubles each time up to a limit; it
/// starts short, because a loose cable is soon back.
class Backoff {
 public:
  using Wait = std::chrono::milliseconds;
  static constexpr Wait kFirst{20};
  static constexpr Wait kLongest{500};

  /// The delay before the next attempt.
  [[nodiscard]] Wait next() noexcept;
  /// Call it after a successful attempt.
  void reset() noexcept { wait_ = kFirst; }

 private:
  Wait wait_ = kFirst;
};

}  // namespace rave::line
