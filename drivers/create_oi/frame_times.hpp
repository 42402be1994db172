// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace rave::oi {

/// When frames were true, from when they came. The robot makes a frame every 15 ms by its own clock
/// and says no time in it; a frame comes late by whatever the line and the host's scheduling add,
/// never early. So the estimate runs ahead by the period with each frame, follows a frame that
/// comes before it at once, and one that comes after it slowly.
///
/// A clock that is off by r leaves a lag of r * period / gain: 0.15 ms at 200 ppm. A frame that
/// was lost shows as a gap of two periods. Pure.
class FrameTimes {
 public:
  explicit FrameTimes(double period_s) : period_s_(period_s) {}

  /// The next frame began to come at `came_s`; gives the estimate of its moment, at most `came_s`
  /// and never before that of the frame before it.
  [[nodiscard]] double next(double came_s);
  /// Forgets all: another connection.
  void reset();

  /// Mean time between frames since the last gap of more than 0.2 s, lost ones counted; 0 before
  /// there are two.
  [[nodiscard]] double measured_period_s() const noexcept;
  /// For how long it has been measured.
  [[nodiscard]] double known_for_s() const noexcept { return estimate_s_ - first_s_; }
  /// Frames that should have come and did not.
  [[nodiscard]] std::uint64_t missing() const noexcept;

 private:
  /// Measures from here.
  void begin(double came_s);

  static constexpr double kGain = 0.02;
  static constexpr double kEarly = 0.2;   ///< Of a period: the estimate may be late by so much.
  static constexpr double kJump_s = 0.2;  ///< Later than this is a new beginning, not a delay.

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
