// SPDX-License-Identifier: Apache-2.0
#include "create_oi/frame_times.hpp"

#include <algorithm>
#include <cmath>

namespace rave::oi {

void FrameTimes::reset() {
  known_ = false;
  missing_ = 0;
  begin(0);
}

void FrameTimes::begin(double came_s) {
  first_s_ = came_s;
  estimate_s_ = came_s;
  periods_ = 0;
  frames_ = 0;
}

double FrameTimes::next(double came_s) {
  if (!known_) {
    known_ = true;
    begin(came_s);
    return estimate_s_;
  }
  const double gap_s = came_s - estimate_s_;
  // The number of periods that have certainly passed. Zero: the previous frame had been delayed and
  // was taken for a later one, or this is a duplicate.
  const auto steps =
      static_cast<std::uint64_t>(std::max(0.0, std::floor(gap_s / period_s_ + kEarly)));
  if (gap_s > kJump_s) {
    // The number of missing frames is now uncertain by one, which would look like a drift of a
    // thousandth, so the measurement restarts.
    missing_ = missing() + steps - 1;
    begin(came_s);
    return estimate_s_;
  }
  if (steps == 0 && frames_ < kSettle) {
    // The first frame was delayed: measure from this one.
    begin(std::max(estimate_s_, came_s));
    return estimate_s_;
  }
  periods_ += steps;
  ++frames_;
  const double expected_s = estimate_s_ + static_cast<double>(steps) * period_s_;
  const double late_s = came_s - expected_s;
  if (late_s <= 0) {
    // A frame cannot arrive before it was made, and times must not decrease.
    estimate_s_ = std::max(estimate_s_, came_s);
  } else if (steps > 0) {
    estimate_s_ = expected_s + kGain * late_s;
  } else if (late_s <= kEarly * period_s_) {
    // The previous frame was counted as two because it was late; this one is the second of them.
    estimate_s_ = came_s;
  }
  return estimate_s_;
}

std::uint64_t FrameTimes::missing() const noexcept {
  return missing_ + (periods_ > frames_ ? periods_ - frames_ : 0);
}

double FrameTimes::measured_period_s() const noexcept {
  return periods_ == 0 ? 0 : (estimate_s_ - first_s_) / static_cast<double>(periods_);
}

}  // namespace rave::oi
