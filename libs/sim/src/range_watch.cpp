// SPDX-License-Identifier: Apache-2.0
// What the guard of a real robot asks of range sensors: that they look where it drives, and that
// what they say is new.
#include "range_watch.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace rave::sim {
namespace {

/// A scan with fewer returns may honestly repeat itself: free space looks the same everywhere, and
/// the range to a wall beside the robot stays.
constexpr int kTelling = 8;

}  // namespace

std::vector<Sectors> ray_sectors(const SensorInfo& sensor) {
  std::vector<Sectors> rays;
  if (sensor.bearings_rad == nullptr) return rays;
  const double spread_rad = 0.5 * sensor.cone_rad;
  for (std::uint32_t i = 0; i < sensor.capacity; ++i) {
    const double axis_rad = sensor.X_RS.yaw + sensor.bearings_rad[i];
    rays.push_back(Sectors::between(axis_rad - spread_rad, axis_rad + spread_rad));
  }
  return rays;
}

RangeWatch::RangeWatch(LiveRanges ranges, double frozen_after_s)
    : ranges_(std::move(ranges)),
      frozen_(frozen_after_s),
      newest_m_(ranges_.queue->max_records()),
      before_m_(newest_m_.size()) {}

void RangeWatch::update() {
  const std::uint32_t before_count = header_.count;
  if (!ranges_.queue->newer_than(header_.sequence, &header_, before_m_.data())) return;
  std::swap(newest_m_, before_m_);
  before_count_ = before_count;
  frozen_.note_sample(repeats());
}

/// Whether the newest sample is the one before once more.
bool RangeWatch::repeats() const noexcept {
  if (header_.count != before_count_) return false;
  int returns = 0;
  for (std::uint32_t i = 0; i < header_.count; ++i) returns += std::isfinite(newest_m_[i]) ? 1 : 0;
  return returns >= kTelling &&
         std::memcmp(newest_m_.data(), before_m_.data(), header_.count * sizeof(float)) == 0;
}

void RangeWatch::add_to(Sight& sight) const noexcept {
  const std::size_t count = std::min<std::size_t>(header_.count, ranges_.rays.size());
  for (std::size_t i = 0; i < count; ++i) sight.add(ranges_.rays[i], newest_m_[i]);
}

}  // namespace rave::sim
