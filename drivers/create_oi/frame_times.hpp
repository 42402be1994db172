// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rave::oi {

/// Estimates when frames were true from their times of arrival. The robot makes a frame every 15 ms
/// by its own clock and sends no time. A frame is delayed by the line and the host's scheduling,
/// and never early. So the estimate advances by one period per frame, follows an earlier arrival at
/// once, and a later one slowly.
///
/// A clock error of r causes a lag of r * period / gain: 0.15 ms at 200 ppm. A lost frame appears
/// as a gap of two periods. Pure.
class FrameTimes {
 public:
  explicit FrameTimes(double period_s) : period_s_(period_s) {}

  /// Adds a frame whose first byte arrived at `came_s`. Returns its estimated time, at most
  /// `came_s` and not before that of the previous frame.
  [[nodiscard]] double next(double came_s);
  /// Clears the state, for another connection.
  void reset();

  /// Mean period of frames since the last gap of more than 0.2 s, lost ones included; 0 with fewer
  /// than two frames.
  [[nodiscard]] double measured_period_s() const noexcept;
  /// The duration of that measurement.
  [[nodiscard]] double known_for_s() const noexcept { return estimate_s_ - first_s_; }
  /// Number of missing frames.
  [[nodiscard]] std::uint64_t missing() const noexcept;

 private:
  /// Restarts the measurement at this time.
  void begin(double came_s);

  static constexpr double kGain = 0.02;
  /// Fraction of a period by which the estimate may be late.
  static constexpr double kEarly = 0.2;
  /// A longer gap restarts the estimate instead of counting as a delay.
  static constexpr double kJump_s = 0.2;

  static constexpr std::uint64_t kSettle = 20;

  double period_s_;
  bool known_ = false;
  double estimate_s_ = 0;
  double first_s_ = 0;
  std::uint64_t periods_ = 0;  // since the first
  std::uint64_t frames_ = 0;   // after the first
  std::uint64_t missing_ = 0;  // before the first
};

}  // namespace rave::oi
