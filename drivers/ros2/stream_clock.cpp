// SPDX-License-Identifier: Apache-2.0
#include "ros2/stream_clock.hpp"

namespace rave::ros2_driver {
namespace {

/// This many old stamps in a row, each newer than the one before, mean that the sender was
/// restarted.
constexpr int kRestartAfter = 10;

}  // namespace

void StreamClock::restart() {
  clock_.reset();
  any_ = false;
  old_in_a_row_ = 0;
}

StreamClock::Taken StreamClock::take(std::int64_t stamp_ns, double arrived_s) {
  if (stamp_ns == 0) return {true, false, arrived_s};
  bool anew = false;
  if (any_ && stamp_ns <= newest_ns_) {
    const bool rising = old_in_a_row_ == 0 || stamp_ns > previous_old_ns_;
    previous_old_ns_ = stamp_ns;
    old_in_a_row_ = rising ? old_in_a_row_ + 1 : 0;
    if (old_in_a_row_ < kRestartAfter) {
      ++old_;
      return {};
    }
    restart();
    anew = true;
  }
  if (!any_) origin_ns_ = stamp_ns;
  // Relative to the first stamp, so that nanoseconds since 1970 keep their precision as a double.
  const double sent_s = static_cast<double>(stamp_ns - origin_ns_) * 1e-9;
  const auto sample = clock_.add(sent_s, arrived_s);
  if (sample == line::ClockOffset::Sample::kEarly) {
    ++early_;
    return {};
  }
  anew = anew || sample == line::ClockOffset::Sample::kSet;
  restarts_ += anew ? 1 : 0;
  any_ = true;
  newest_ns_ = stamp_ns;
  old_in_a_row_ = 0;
  return {true, anew, sent_s + clock_.offset_s(sent_s)};
}

}  // namespace rave::ros2_driver
