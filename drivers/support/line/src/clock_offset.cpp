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
  late_in_a_row_ = 0;
  offset_s_ = 0;
  drift_ = 0;
  origin_s_ = 0;
  newest_s_ = 0;
}

void ClockOffset::add(double device_s, double host_s) {
  if (!std::isfinite(device_s) || !std::isfinite(host_s)) return;
  const double difference_s = host_s - device_s;
  if (known()) {
    if (stepped(device_s, difference_s)) {
      reset();
      ++restarts_;
    } else if (late_in_a_row_ > 0) {
      return;  // so late that it says nothing about the clock
    }
  }
  newest_s_ = device_s;
  keep({device_s, difference_s});
  fit();
}

bool ClockOffset::stepped(double device_s, double difference_s) {
  // A device time that steps back is one of a device that was restarted.
  if (device_s < newest_s_) return true;
  const double excess_s = difference_s - offset_s(device_s);
  // No sample arrives before it is sent, so the clock must have jumped forward.
  if (excess_s < -options_.jump_s) return true;
  // A single late sample is a delay. Many in a row mean that the clock was set.
  late_in_a_row_ = excess_s > options_.jump_s ? late_in_a_row_ + 1 : 0;
  return late_in_a_row_ >= options_.jump_samples;
}

void ClockOffset::keep(Point point) {
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
  // A quartz clock cannot drift more, so a steeper slope comes from delays.
  return std::clamp(slope, -options_.max_drift, options_.max_drift);
}

void ClockOffset::fit() {
  origin_s_ = buckets_.back().x;
  const bool long_enough = origin_s_ - buckets_.front().x >= options_.slope_after_s;
  drift_ = long_enough ? hull_slope() : 0;
  // With a clamped slope, or none, every sample must still be above the line.
  offset_s_ = buckets_.back().y;
  for (const Point& p : buckets_) {
    offset_s_ = std::min(offset_s_, p.y - drift_ * (p.x - origin_s_));
  }
}

}  // namespace rave::line
