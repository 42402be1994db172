// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "rave/sim/drive.hpp"

namespace rave::sim {

/// Whether a sensor repeats itself, to the bit, although the robot was told to move: no sensor of a
/// robot that moves does. Rising stamps prove nothing: an old value that is sent again gets a new
/// stamp. One thread.
class FrozenWatch {
 public:
  /// `after_s`: a value may stay for so long while the robot is commanded to move: its drive has to
  /// begin, and the sensor has to see that. 0: never frozen.
  explicit FrozenWatch(double after_s) noexcept : after_s_(after_s) {}

  /// The robot obeyed a velocity for `dt_s`.
  void note_told(const Twist2& told, double dt_s) noexcept {
    const double v_mps = speed_of(told);
    const double w_radps = std::abs(told.wz);
    if (v_mps == 0 && w_radps == 0) return;
    told_s_ += dt_s;
    way_m_ += v_mps * dt_s;
    turn_rad_ += w_radps * dt_s;
  }
  /// A sample has come. `same`: it says what the one before said.
  void note_sample(bool same) noexcept {
    if (!same) {
      reset();
      return;
    }
    repeats_ = std::min(repeats_ + 1, kRepeats);
  }
  /// It is believed again until the robot has been told to move anew.
  void reset() noexcept { told_s_ = way_m_ = turn_rad_ = repeats_ = 0; }

  [[nodiscard]] bool is_frozen() const noexcept {
    return after_s_ > 0 && repeats_ >= kRepeats && told_s_ >= after_s_ &&
           (way_m_ >= kWay_m || turn_rad_ >= kTurn_rad);
  }
  /// How long the robot has been told to move since the value changed.
  [[nodiscard]] double told_s() const noexcept { return repeats_ > 0 ? told_s_ : 0; }

 private:
  /// What is slower than its samples may say the same twice.
  static constexpr int kRepeats = 3;
  /// Any sensor notices a motion of this size.
  static constexpr double kWay_m = 0.05;
  static constexpr double kTurn_rad = 0.1;

  double after_s_;
  double told_s_ = 0;
  double way_m_ = 0;
  double turn_rad_ = 0;
  int repeats_ = 0;
};

}  // namespace rave::sim
