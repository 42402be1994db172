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
/// Pure: reads no clock. Not thread-safe.
class ClockOffset {
 public:
  /// How samples are chosen and trusted.
  struct Options {
    double window_s = 30;  ///< How long a sample is used.
    /// Only the least delayed sample of each interval of this length is kept.
    double bucket_s = 0.5;
    /// No drift is computed from shorter spans, because it would be noise.
    double slope_after_s = 5;
    double max_drift = 500e-6;  ///< Largest error of a quartz clock.
    double jump_s = 0.5;        ///< After a larger clock step the estimate restarts, ...
    /// ... forward only after this many in a row, because samples may just be late.
    std::int32_t jump_samples = 20;
  };

  ClockOffset() : ClockOffset(Options{}) {}
  explicit ClockOffset(const Options& options) : options_(options) {}

  /// Adds a sample with device time `device_s` that arrived at `host_s`. A decreasing device time
  /// restarts the estimate.
  void add(double device_s, double host_s);
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
  /// The number of restarts after steps of the device's clock.
  [[nodiscard]] std::uint64_t restarts() const noexcept { return restarts_; }

 private:
  struct Point {
    double x = 0;  ///< Device time, seconds.
    double y = 0;  ///< Arrival minus device time.
  };

  [[nodiscard]] bool stepped(double device_s, double difference_s);
  void keep(Point point);
  void fit();
  [[nodiscard]] double hull_slope();

  Options options_;
  std::deque<Point> buckets_;  // ascending x
  std::vector<Point> hull_;
  double bucket_end_s_ = 0;
  double newest_s_ = 0;
  double origin_s_ = 0;
  double offset_s_ = 0;
  double drift_ = 0;
  std::int32_t late_in_a_row_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace rave::line
