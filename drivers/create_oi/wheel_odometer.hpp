// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

#include "rave/math/pose.hpp"
#include "rave/math/pose_covariance.hpp"
#include "rave/robot/reading.hpp"

namespace rave::oi {

/// Pose and velocity from the counts of two 16-bit encoders. The pose is 0 at the first counts.
/// Source of the covariance growth: see PoseCovariance.
///
/// Counts that the wheels cannot have made since the last ones are rejected, because a corrupted
/// frame may pass its checksum. If such counts persist, or both counters start at 0 after a pause,
/// the robot was restarted: the pose continues from its last value, with the uncertainty of an
/// unseen drive. Pure; not thread-safe.
class WheelOdometer {
 public:
  struct Options {
    double wheel_base_m = 0.235;
    double counts_per_m = 2249.4;  ///< 508.8 counts per revolution of a wheel of 72 mm.
    /// Standard deviation of the travel of one wheel after one metre.
    double noise_per_metre_m = 0.02;
    double max_wheel_mps = 0.5;
    double window_s = 0.1;  ///< Averaging time of the velocity.
  };

  explicit WheelOdometer(const Options& options) : options_(options) {}

  /// Adds the counts at `t_s`, which must not decrease. False: rejected, nothing changes.
  bool step(std::uint16_t left_counts, std::uint16_t right_counts, double t_s);
  [[nodiscard]] OdometryReading reading() const noexcept;

  [[nodiscard]] std::uint64_t disbelieved() const noexcept { return disbelieved_; }
  /// The number of restarts of the robot.
  [[nodiscard]] std::uint64_t restarts() const noexcept { return restarts_; }

 private:
  struct Mark {
    double t_s = 0;
    double left_m = 0;
    double right_m = 0;
  };

  void begin(std::uint16_t left_counts, std::uint16_t right_counts, double t_s);
  void doubt(double unseen_s);
  void move(double left_m, double right_m);
  void keep_mark(double t_s);

  Options options_;
  bool known_ = false;
  std::uint16_t left_counts_ = 0;
  std::uint16_t right_counts_ = 0;
  double t_s_ = 0;
  double left_m_ = 0;  // total travel
  double right_m_ = 0;
  Pose2 X_OR_;  // O is the frame at the start
  PoseCovariance covariance_;
  std::deque<Mark> marks_;
  std::int32_t odd_in_a_row_ = 0;
  std::uint64_t disbelieved_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace rave::oi
