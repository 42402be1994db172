// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace rave::line {

/// How long to wait before the next attempt to reach a device: twice as long each time, up to a
/// limit. Short at first, because a cable that slipped is back at once.
class Backoff {
 public:
  using Wait = std::chrono::milliseconds;
  static constexpr Wait kFirst{20};
  static constexpr Wait kLongest{500};

  /// The wait that stands before the next attempt.
  [[nodiscard]] Wait next() noexcept;
  /// The device answered.
  void reset() noexcept { wait_ = kFirst; }

 private:
  Wait wait_ = kFirst;
};

}  // namespace rave::line
