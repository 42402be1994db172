// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace rave::line {

/// Relates the clock of a device to that of the host, using only samples with the device's time
/// that arrive after some delay. The result is offset + least delay; one-way traffic cannot
/// separate the two.
///
/// For each sample, arrival minus device time is above the line `offset + drift * time` by its
/// delay. The line is the edge of the lower convex hull of recent samples that is below their mean;
/// of all lines below the samples it has the least sum of delays. Source: S. B. Moon, P. Skelly, D.
/// Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM 1999.
///
/// Samples that fall behind are late: the offset never grows faster than a clock can drift, however
/// many there are. The other way round, samples that seem to arrive before they were sent, only a
/// clock that was set explains it.
///
/// Pure: reads no clock. Not thread-safe.
class ClockOffset {
 public:
  /// What a sample turned out to be.
  enum class Sample {
    kGood,   ///< It counts, however late it is.
    kEarly,  ///< It seems to arrive before it was sent: not believed, it changed nothing.
    kSet,    ///< The last of many such: the clock was set, and the estimate begins anew with it.
  };

  /// How samples are chosen and trusted.
  struct Options {
    double window_s = 30;  ///< How long a sample is used.
    /// Only the least delayed sample of each interval of this length is kept.
    double bucket_s = 0.5;
    /// No drift is computed from shorter spans, because it would be noise.
    double slope_after_s = 5;
    double max_drift = 500e-6;  ///< Largest error of a quartz clock.
    double jump_s = 0.5;        ///< A sample that comes earlier by this is not believed, ...
    /// ... unless this number in a row agree on where the clock is.
    std::int32_t jump_samples = 10;
    /// For this time the first sample may have been a late one, so that a much earlier one is good.
    double settle_s = 2;
  };

  ClockOffset() : ClockOffset(Options{}) {}
  explicit ClockOffset(const Options& options) : options_(options) {}

  /// Adds a sample with device time `device_s`, which must not decrease without a reset(), that
  /// arrived at `host_s`. What is no number changes nothing and is good.
  [[nodiscard]] Sample add(double device_s, double host_s);
  /// Clears everything except the count of restarts.
  void reset();

  [[nodiscard]] bool known() const noexcept { return !buckets_.empty(); }
  /// Host time minus device time at device time `device_s`; 0 if unknown.
  [[nodiscard]] double offset_s(double device_s) const noexcept {
    return offset_s_ + drift_ * (device_s - origin_s_);
  }
  /// Offset at the newest sample.
  [[nodiscard]] double offset_s() const noexcept { return offset_s(newest_s_); }
  /// By how much the host's clock runs faster, in parts per million.
  [[nodiscard]] double drift_ppm() const noexcept { return drift_ * 1e6; }
  /// How often the clock was set.
  [[nodiscard]] std::uint64_t restarts() const noexcept { return restarts_; }

 private:
  struct Point {
    double x = 0;  ///< Device time, seconds.
    double y = 0;  ///< Arrival minus device time.
  };

  [[nodiscard]] Sample judge(Point point);
  void keep(Point point);
  void fit();
  [[nodiscard]] double hull_slope();

  Options options_;
  std::deque<Point> buckets_;  // ascending x
  std::vector<Point> hull_;
  double bucket_end_s_ = 0;
  double first_s_ = 0;
  Point floor_;  // the lowest sample of all, raised by what a clock can have drifted since
  double newest_s_ = 0;
  double origin_s_ = 0;
  double offset_s_ = 0;
  double drift_ = 0;
  std::int32_t early_in_a_row_ = 0;
  Point early_;  // the last sample that was not believed
  std::uint64_t restarts_ = 0;
};

}  // namespace rave::line
