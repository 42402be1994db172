// SPDX-License-Identifier: Apache-2.0
#include "create_oi/frame_times.hpp"

#include <algorithm>
#include <cmath>

namespace rave::oi {

void FrameTimes::reset() {
  known_ = false;
  periods_ = 0;
  frames_ = 0;
}

double FrameTimes::next(double came_s) {
  if (!known_) {
    known_ = true;
    first_s_ = came_s;
    estimate_s_ = came_s;
    return estimate_s_;
  }
  const double gap_s = came_s - estimate_s_;
  // As many periods as surely have passed. None: this one came together with the one before, which
  // had stood still on the line and was taken for a later one; or it is the same once more.
  const double steps = std::max(0.0, std::floor(gap_s / period_s_ + kEarly));
  periods_ += static_cast<std::uint64_t>(steps);
  ++frames_;
  const double expected_s = estimate_s_ + steps * period_s_;
  const double late_s = came_s - expected_s;
  if (late_s <= 0 || steps == 0 || gap_s > kJump_s) {
    // It cannot have come before it was made; and time does not step back.
    estimate_s_ = std::max(estimate_s_, came_s);
  } else {
    estimate_s_ = expected_s + kGain * late_s;
  }
  if (steps == 0 && frames_ < kSettle) {
    // It was the first one that came late: measure from here.
    first_s_ = estimate_s_;
    periods_ = 0;
    frames_ = 0;
  }
  return estimate_s_;
}

double FrameTimes::measured_period_s() const noexcept {
  return periods_ == 0 ? 0 : (estimate_s_ - first_s_) / static_cast<double>(periods_);
}

}  // namespace rave::oi
