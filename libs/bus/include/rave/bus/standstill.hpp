// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "rave/base/time.hpp"

namespace rave::bus {

/// Detects that this process was unable to run: stopped, suspended with its machine, or without a
/// processor. Other processes then seem silent although they were not. One owner thread.
class Standstill {
 public:
  using Clock = std::chrono::steady_clock;

  /// `longest`: a process that runs calls look() at least this often. `grace`: the time that others
  /// need to be heard again after a standstill.
  Standstill(Duration longest, Duration grace) : longest_(longest), grace_(grace) {}

  /// Call it often, and after each wait. `waited`: the longest time that the wait may have taken;
  /// negative: unlimited.
  void look(Duration waited = {});
  /// Like look(waited), with given clock readings: `now` of the clock of deadlines, `elapsed` of a
  /// clock that also counts while the machine is suspended.
  void look(Clock::time_point now, std::chrono::nanoseconds elapsed, Duration waited);

  /// Silence before this time proves nothing. The epoch of the clock if there was no standstill.
  [[nodiscard]] Clock::time_point silence_counts_from() const noexcept { return counts_from_; }
  /// Duration of the last standstill: the longest of those before silence counted again.
  [[nodiscard]] Duration stood() const noexcept { return stood_; }

 private:
  Duration longest_;
  Duration grace_;
  std::chrono::nanoseconds last_{-1};
  Clock::time_point counts_from_{};
  Duration stood_{};
};

}  // namespace rave::bus
