// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "rave/math/pose.hpp"

namespace rave::estimate {

/// How well a robot follows commands. The values are those of no single robot; they fit small
/// indoor robots with wheels.
struct MotionModel {
  double delay_s = 0.25;              ///< Until a command shows in the motion.
  double turning_share = 0.92;        ///< Of the commanded turning rate that the robot reaches.
  double turning_share_sigma = 0.05;  ///< How far that differs from robot to robot.
  double share_drift = 0.002;         ///< Random walk of that share, per square root of a second.
  double along_sigma = 0.02;          ///< Metres per square root of a metre driven.
  double turn_sigma = 0.12;           ///< Radians per square root of a radian turned.
  double still_sigma = 0.004;         ///< Radians per square root of a second, always.
};

/// Noise of a sighting, and when one is not believed.
struct SightingModel {
  double range_sigma_m = 0.12;
  double bearing_sigma_rad = 0.02;
  /// Squared Mahalanobis distance beyond which a sighting is refused: 13.8 is 99.9 % of a
  /// chi-squared distribution with two degrees of freedom.
  double gate = 13.8;
  /// After this number of refusals in a row the filter doubts itself: its covariance grows until a
  /// sighting is believed again.
  int refusals_until_doubt = 4;
};

/// A place with its covariance (m²), as the target of a sighting.
struct Place {
  Vec2 p_W;
  std::array<double, 4> covariance{};  ///< Row by row; zeros: exactly known.
};

/// The pose of one robot in the world by an extended Kalman filter: commands move it, ranges and
/// bearings to known places correct it. S. Thrun, W. Burgard, D. Fox: "Probabilistic Robotics", MIT
/// Press 2005, chapter 7. The share of the turning rate that the robot reaches is estimated too, so
/// that a blind stretch is short in error. A sighting of another robot counts with the covariance
/// of that robot's own filter; correlations between filters are not kept.
///
/// A value type; one thread at a time. Same input, same bits.
class PoseFilter {
 public:
  static constexpr int kStates = 4;  ///< x (m), y (m), heading (rad), share of turning.

  /// `X_WR`: the first pose, with its standard deviations. Precondition: finite, sigmas >= 0.
  PoseFilter(const MotionModel& motion, const SightingModel& sighting, const Pose2& X_WR,
             double position_sigma_m, double heading_sigma_rad);

  /// Moves the estimate by `dt_s` >= 0 seconds of a velocity forwards (m/s) and a turning rate
  /// (rad/s) as commanded. The delay of commands is the caller's, such as TeamFilter.
  void move(double v_mps, double w_radps, double dt_s);

  /// Corrects by a sighting: the range (m) and the bearing (rad, in the frame of the robot,
  /// counterclockwise) of `target`. False: refused by the gate, or not finite.
  bool see(const Place& target, double range_m, double bearing_rad);

  /// Corrects by the robot being seen: `target` is where the observer takes it to be.
  bool seen_at(const Place& target);

  [[nodiscard]] Pose2 pose() const noexcept { return {state_[0], state_[1], state_[2]}; }
  [[nodiscard]] Place place() const noexcept;
  /// Variance of the heading, rad².
  [[nodiscard]] double heading_variance() const noexcept { return covariance_[10]; }
  [[nodiscard]] double turning_share() const noexcept { return state_[3]; }
  /// Where the target of a sighting by this robot is, from the pose with its covariance.
  [[nodiscard]] Place project(double range_m, double bearing_rad) const;

 private:
  struct Innovation;
  bool correct(const Innovation& innovation);

  MotionModel motion_;
  SightingModel sighting_;
  std::array<double, kStates> state_{};
  std::array<double, kStates * kStates> covariance_{};  ///< Row by row.
  int refusals_ = 0;
};

}  // namespace rave::estimate
