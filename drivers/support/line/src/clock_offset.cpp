// SPDX-License-Identifier: Apache-2.0
#include "rave/line/clock_offset.hpp"

#include <algorithm>
#include <cmath>

namespace rave::line {

// Each sample gives host time minus device time, which is the offset of the clocks plus a delay
// that is never negative. So the true line lies below all points, and the best estimate touches
// them from below: the edge of the lower convex hull below the mean (Moon, Skelly, Towsley; see
// README.md). A mean through the points would follow the delays instead.
void ClockOffset::reset() {
  buckets_.clear();
  early_in_a_row_ = 0;
  offset_s_ = 0;
  drift_ = 0;
  origin_s_ = 0;
  newest_s_ = 0;
}

ClockOffset::Sample ClockOffset::add(double device_s, double host_s) {
  if (!std::isfinite(device_s) || !std::isfinite(host_s)) return Sample::kGood;
  const Point point{device_s, host_s - device_s};
  const Sample sample = known() ? judge(point) : Sample::kGood;
  if (sample == Sample::kEarly) return sample;
  if (sample == Sample::kSet) {
    reset();
    ++restarts_;
  }
  if (!known()) {
    first_s_ = device_s;
    floor_ = point;
  }
  early_in_a_row_ = 0;
  newest_s_ = device_s;
  if (known() && point.y - offset_s(device_s) > options_.jump_s) {
    // So late that it says nothing of the clock, which continues as it did.
    floor_ = {device_s, floor_.y + drift_ * (device_s - floor_.x)};
    return sample;
  }
  keep(point);
  fit();
  return sample;
}

ClockOffset::Sample ClockOffset::judge(Point point) {
  // Late samples are never a reason to think that the clock was set: a queue that fills up on the
  // way delays all of them, and an estimate that followed would call them fresh.
  if (point.y - offset_s(point.x) > -options_.jump_s) return Sample::kGood;
  if (point.x - first_s_ < options_.settle_s) return Sample::kGood;
  // One wrong stamp is no clock that was set: many have to say the same.
  const bool agrees =
      early_in_a_row_ > 0 && point.x > early_.x && std::abs(point.y - early_.y) < options_.jump_s;
  early_in_a_row_ = agrees ? early_in_a_row_ + 1 : 1;
  early_ = point;
  return early_in_a_row_ < options_.jump_samples ? Sample::kEarly : Sample::kSet;
}

void ClockOffset::keep(Point point) {
  // What the window forgets is not forgotten here. Otherwise a lag that grows slowly would become
  // part of the offset.
  const double raised_s = floor_.y + options_.max_drift * (point.x - floor_.x);
  floor_ = {point.x, std::min(raised_s, point.y)};
  // Only the least delayed sample of each interval can touch the line, so memory and time do not
  // grow with the rate of samples.
  if (buckets_.empty() || point.x >= bucket_end_s_) {
    buckets_.push_back(point);
    bucket_end_s_ = point.x + options_.bucket_s;
  } else if (point.y < buckets_.back().y) {
    buckets_.back() = point;
  }
  while (buckets_.front().x < point.x - options_.window_s) buckets_.pop_front();
}

double ClockOffset::hull_slope() {
  hull_.clear();
  double sum_x = 0;
  for (const Point& p : buckets_) {
    sum_x += p.x;
    while (hull_.size() >= 2) {
      const Point& a = hull_[hull_.size() - 2];
      const Point& b = hull_.back();
      // Andrew's monotone chain: the cross product says whether b lies below the line from a to p.
      if ((b.x - a.x) * (p.y - a.y) > (b.y - a.y) * (p.x - a.x)) break;
      hull_.pop_back();
    }
    hull_.push_back(p);
  }
  const double mean_x = sum_x / static_cast<double>(buckets_.size());
  std::size_t i = 1;
  while (i + 1 < hull_.size() && hull_[i].x < mean_x) ++i;
  const double slope = (hull_[i].y - hull_[i - 1].y) / (hull_[i].x - hull_[i - 1].x);
  // A quartz clock cannot drift more, so a steeper slope comes from delays that grow or shrink.
  return std::abs(slope) <= options_.max_drift ? slope : drift_;
}

void ClockOffset::fit() {
  origin_s_ = buckets_.back().x;
  const bool long_enough = origin_s_ - buckets_.front().x >= options_.slope_after_s;
  if (long_enough) drift_ = hull_slope();
  // With another slope than theirs, or none, every sample must still be above the line.
  offset_s_ = floor_.y - drift_ * (floor_.x - origin_s_);
  for (const Point& p : buckets_) {
    offset_s_ = std::min(offset_s_, p.y - drift_ * (p.x - origin_s_));
  }
}

}  // namespace rave::line
