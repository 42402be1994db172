// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

#include "rave/math/pose.hpp"
#include "rave/math/pose_covariance.hpp"
#include "rave/robot/reading.hpp"

namespace rave::oi {

/// Pose and velocity from the counts of two encoders of 16 bits. The pose begins at 0 where the
/// first counts were read. Source of the growth of the covariance: see PoseCovariance.
///
/// Counts that the wheels cannot have made since the last ones are not believed: a garbled frame
/// may pass its checksum. If they stay, or both counters begin at 0 again after a pause, the robot
/// was restarted: the pose goes on from where it was, with the doubt of what it may have driven
/// unseen. Pure; not for several threads at once.
class WheelOdometer {
 public:
  struct Options {
    double wheel_base_m = 0.235;
    double counts_per_m = 2249.4;     ///< 508.8 counts a turn of a wheel of 72 mm.
    double noise_per_metre_m = 0.02;  ///< Deviation of the travel of one wheel after one metre.
    double max_wheel_mps = 0.5;
    double window_s = 0.1;  ///< The velocity is the mean over this long.
  };

  explicit WheelOdometer(const Options& options) : options_(options) {}

  /// The counts at `t_s`, which must not step back. False: not believed, nothing changed.
  bool step(std::uint16_t left_counts, std::uint16_t right_counts, double t_s);
  [[nodiscard]] OdometryReading reading() const noexcept;

  [[nodiscard]] std::uint64_t disbelieved() const noexcept { return disbelieved_; }
  /// How often it began anew after a restart of the robot.
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
  double left_m_ = 0;  // travel in all
  double right_m_ = 0;
  Pose2 X_OR_;  // O is where it began
  PoseCovariance covariance_;
  std::deque<Mark> marks_;
  std::int32_t odd_in_a_row_ = 0;
  std::uint64_t disbelieved_ = 0;
  std::uint64_t restarts_ = 0;
};

}  // namespace rave::oi
