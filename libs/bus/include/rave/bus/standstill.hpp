// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "rave/base/time.hpp"

namespace rave::bus {

/// Notices that its process stood still: it was stopped, its machine was suspended, or it got no
/// processor. Others seem silent for that time although they were not. One owner thread.
class Standstill {
 public:
  using Clock = std::chrono::steady_clock;

  /// `longest`: a process that goes looks at its clock again within this time. `grace`: what others
  /// need to be heard again after it stood.
  Standstill(Duration longest, Duration grace) : longest_(longest), grace_(grace) {}

  /// To be called often, and after each wait. `waited`: the time that the wait was allowed to
  /// take; below 0: any.
  void look(Duration waited = {});
  /// The same with given readings: of the clock that deadlines are measured with, and of one that
  /// goes on while the machine is suspended.
  void look(Clock::time_point now, std::chrono::nanoseconds elapsed, Duration waited);

  /// Silence before this time proves nothing. The beginning of the clock if it never stood.
  [[nodiscard]] Clock::time_point silence_counts_from() const noexcept { return counts_from_; }
  /// For how long it stood the last time: the longest until silence counted again.
  [[nodiscard]] Duration stood() const noexcept { return stood_; }

 private:
  Duration longest_;
  Duration grace_;
  std::chrono::nanoseconds last_{-1};
  Clock::time_point counts_from_{};
  Duration stood_{};
};

}  // namespace rave::bus
