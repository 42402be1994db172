// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

namespace rave::line {

/// Relates the clock of a device to that of the host, from nothing but samples that bear the
/// device's time and arrive after some delay. What is found is offset + smallest delay: the two
/// cannot be told apart by one-way traffic.
///
/// For each sample, arrival minus device time lies above the line `offset + drift * time` by its
/// delay. The line is the edge of the lower convex hull of the recent samples that lies under their
/// mean, which has the least sum of delays of all lines below them. Source: S. B. Moon, P. Skelly,
/// D. Towsley, "Estimation and removal of clock skew from network delay measurements", INFOCOM
/// 1999.
///
/// Pure: no clock is read. Not for several threads at once.
class ClockOffset {
 public:
  struct Options {
    double window_s = 30;            ///< How long a sample counts.
    double bucket_s = 0.5;           ///< Of this long only the least delayed sample is kept.
    double slope_after_s = 5;        ///< Less than this gives no drift: it would be noise.
    double max_drift = 500e-6;       ///< What a quartz may be off by.
    double jump_s = 0.5;             ///< A clock that steps by more is learnt anew, ...
    std::int32_t jump_samples = 20;  ///< ... forward after this many in a row: they may be late.
  };

  ClockOffset() : ClockOffset(Options{}) {}
  explicit ClockOffset(const Options& options) : options_(options) {}

  /// A sample that bears `device_s` came at `host_s`. A device time that steps back starts anew.
  void add(double device_s, double host_s);
  /// Forgets everything but the count of restarts.
  void reset();

  [[nodiscard]] bool known() const noexcept { return !buckets_.empty(); }
  /// Host time minus device time when the device's clock shows `device_s`; 0 if nothing is known.
  [[nodiscard]] double offset_s(double device_s) const noexcept {
    return offset_s_ + drift_ * (device_s - origin_s_);
  }
  /// Offset at the newest sample.
  [[nodiscard]] double offset_s() const noexcept { return offset_s(newest_s_); }
  /// How much faster the host's clock runs, parts in a million.
  [[nodiscard]] double drift_ppm() const noexcept { return drift_ * 1e6; }
  /// How often a step of the device's clock made it start anew.
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
