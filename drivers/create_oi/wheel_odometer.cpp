// SPDX-License-Identifier: Apache-2.0
#include "create_oi/wheel_odometer.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::oi {
namespace {

constexpr double kMargin = 1.3;         // the robot's speed control overshoots
constexpr double kSlack_s = 0.05;       // stamps jitter, and late frames come in bursts
constexpr double kPause_s = 0.25;       // longer without a frame counts as an interruption
constexpr double kLongestPause_s = 20;  // after longer the counters may have wrapped more than once
constexpr std::int32_t kOddFrames = 5;  // implausible frames in a row: not corruption but a restart
constexpr std::int32_t kNearZero = 40;  // counts

/// The difference of two counter values, modulo 2^16.
std::int32_t counted(std::uint16_t before, std::uint16_t now) noexcept {
  // The counters have 16 bits and roll over. The signed difference is right as long as a wheel
  // turns less than 2^15 counts between two frames, 14.6 m.
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(now - before));
}

bool near_zero(std::uint16_t counts) noexcept { return std::abs(counted(0, counts)) < kNearZero; }

}  // namespace

void WheelOdometer::begin(std::uint16_t left_counts, std::uint16_t right_counts, double t_s) {
  known_ = true;
  left_counts_ = left_counts;
  right_counts_ = right_counts;
  t_s_ = t_s;
  odd_in_a_row_ = 0;
  marks_.clear();
  keep_mark(t_s);
}

/// Uncertainty of the unseen drive: a uniform distribution over the distance that the robot could
/// drive.
void WheelOdometer::doubt(double unseen_s) {
  // A uniform distribution over plus and minus d has the variance d^2 / 3.
  const double far_m = options_.max_wheel_mps * unseen_s;
  const double turn_rad = std::min(2 * far_m / options_.wheel_base_m, kPi);
  covariance_.xx += far_m * far_m / 3;
  covariance_.yy += far_m * far_m / 3;
  covariance_.tt += turn_rad * turn_rad / 3;
}

bool WheelOdometer::step(std::uint16_t left_counts, std::uint16_t right_counts, double t_s) {
  if (!known_) {
    begin(left_counts, right_counts, t_s);
    return true;
  }
  const double dt_s = t_s - t_s_;
  const std::int32_t left = counted(left_counts_, left_counts);
  const std::int32_t right = counted(right_counts_, right_counts);
  const double most =
      kMargin * options_.max_wheel_mps * (dt_s + kSlack_s) * options_.counts_per_m + 2;
  const bool odd = std::max(std::abs(left), std::abs(right)) > most;
  // A robot that was switched off and on again counts from 0. A jump of both counters to near 0
  // within normal driving is unlikely.
  const bool zeroed = dt_s > kPause_s && near_zero(left_counts) && near_zero(right_counts) &&
                      std::max(std::abs(left), std::abs(right)) > 2 * kNearZero;
  if (odd) {
    ++disbelieved_;
    ++odd_in_a_row_;
  }
  if (zeroed || dt_s > kLongestPause_s || odd_in_a_row_ >= kOddFrames) {
    doubt(dt_s);
    ++restarts_;
    begin(left_counts, right_counts, t_s);
    return true;
  }
  if (odd) return false;
  odd_in_a_row_ = 0;
  left_counts_ = left_counts;
  right_counts_ = right_counts;
  t_s_ = t_s;
  move(left / options_.counts_per_m, right / options_.counts_per_m);
  keep_mark(t_s);
  return true;
}

void WheelOdometer::move(double left_m, double right_m) {
  if (left_m == 0 && right_m == 0) return;
  left_m_ += left_m;
  right_m_ += right_m;
  const double length_m = 0.5 * (left_m + right_m);
  const double turn_rad = (right_m - left_m) / options_.wheel_base_m;
  const double per_metre_m = options_.noise_per_metre_m * options_.noise_per_metre_m;
  const double left_m2 = per_metre_m * std::abs(left_m);
  const double right_m2 = per_metre_m * std::abs(right_m);
  const double base_m = options_.wheel_base_m;
  covariance_.grow(length_m, sincos(X_OR_.yaw + 0.5 * turn_rad),
                   // Variances of l = (a + b) / 2 and of t = (b - a) / base for independent wheels
                   // a and b, and their covariance. Siegwart and Nourbakhsh, "Introduction to
                   // Autonomous Mobile Robots", 2004, 5.2.4.
                   {0.25 * (left_m2 + right_m2), (left_m2 + right_m2) / (base_m * base_m),
                    0.5 * (right_m2 - left_m2) / base_m});
  X_OR_ = integrate(X_OR_, {length_m, 0, turn_rad}, 1.0);
}

void WheelOdometer::keep_mark(double t_s) {
  // Frames of a burst have the same time: the last one counts.
  if (!marks_.empty() && marks_.back().t_s >= t_s) marks_.pop_back();
  marks_.push_back({t_s, left_m_, right_m_});
  while (marks_.size() > 2 && marks_[1].t_s <= t_s - options_.window_s) marks_.pop_front();
}

OdometryReading WheelOdometer::reading() const noexcept {
  OdometryReading reading;
  reading.x_m = X_OR_.x;
  reading.y_m = X_OR_.y;
  reading.yaw_rad = X_OR_.yaw;
  reading.variance_xy_m2 = 0.5 * (covariance_.xx + covariance_.yy);
  reading.variance_yaw_rad2 = covariance_.tt;
  if (marks_.size() < 2) return reading;
  const Mark& first = marks_.front();
  const Mark& last = marks_.back();
  const double dt_s = last.t_s - first.t_s;
  const double left_mps = (last.left_m - first.left_m) / dt_s;
  const double right_mps = (last.right_m - first.right_m) / dt_s;
  reading.v_mps = 0.5 * (left_mps + right_mps);
  reading.w_radps = (right_mps - left_mps) / options_.wheel_base_m;
  return reading;
}

}  // namespace rave::oi
