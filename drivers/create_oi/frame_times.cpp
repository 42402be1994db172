// SPDX-License-Identifier: Apache-2.0
#include "create_oi/frame_times.hpp"

#include <algorithm>
#include <cmath>

namespace rave::oi {

void FrameTimes::reset() {
  known_ = false;
  periods_ = 0;
  missing_ = 0;
}

double FrameTimes::next(double came_s) {
  if (!known_) {
    known_ = true;
    first_s_ = came_s;
    estimate_s_ = came_s;
    return estimate_s_;
  }
  const double gap_s = came_s - estimate_s_;
  const double steps = std::max(1.0, std::round(gap_s / period_s_));
  periods_ += static_cast<std::uint64_t>(steps);
  missing_ += static_cast<std::uint64_t>(steps) - 1;
  const double expected_s = estimate_s_ + steps * period_s_;
  const double late_s = came_s - expected_s;
  if (late_s <= 0 || gap_s > kJump_s) {
    // It cannot have come before it was made. A frame that stood still on the line comes together
    // with the next one: then time does not step back either.
    estimate_s_ = std::max(estimate_s_, came_s);
  } else {
    estimate_s_ = expected_s + kGain * late_s;
  }
  return estimate_s_;
}

double FrameTimes::measured_period_s() const noexcept {
  return periods_ == 0 ? 0 : (estimate_s_ - first_s_) / static_cast<double>(periods_);
}

}  // namespace rave::oi
