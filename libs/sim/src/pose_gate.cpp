// SPDX-License-Identifier: Apache-2.0
#include "pose_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rave/math/finite.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

// Where neither file nor guard says how fast it is.
constexpr double kDriven_mps = 10;
constexpr double kWatched_mps = 50;  // without commands: a car, a person
constexpr double kTurn_radps = 2 * kPi;

constexpr double kMargin = 1.3;   // the robot's speed control overshoots, a person pushes it
constexpr double kSlack_s = 0.1;  // stamps jitter
// A localisation that corrects itself.
constexpr double kCorrection_m = 0.5;
constexpr double kCorrection_rad = deg_to_rad(20);
constexpr double kSigmas = 3;

constexpr std::int32_t kAgreeing = 5;
constexpr Duration kAgreeing_for{500'000'000};

/// The noise of the difference of two readings.
double noise(double variance, double other) noexcept {
  return kSigmas * std::sqrt(std::max(variance, 0.0) + std::max(other, 0.0));
}

double distance_m(const PoseReading& from, const PoseReading& to) noexcept {
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  return std::sqrt(dx_m * dx_m + dy_m * dy_m);
}

std::string text_of(const PoseReading& pose) {
  return fmt::format("({:.2f}, {:.2f}) m, {:.0f} deg", pose.x_m, pose.y_m,
                     rad_to_deg(pose.yaw_rad));
}

}  // namespace

PoseReach reach_of(const RobotType& type) noexcept {
  PoseReach reach{type.actuators.empty() ? kWatched_mps : kDriven_mps, kTurn_radps};
  if (type.guard && std::isfinite(type.guard->max_speed_mps)) {
    reach.max_speed_mps = type.guard->max_speed_mps;
  }
  if (type.guard && std::isfinite(type.guard->max_turn_radps)) {
    reach.max_turn_radps = type.guard->max_turn_radps;
  }
  return {type.pose_max_speed_mps.value_or(reach.max_speed_mps),
          type.pose_max_turn_radps.value_or(reach.max_turn_radps)};
}

bool PoseGate::reaches(const Place& from, const Place& to) const noexcept {
  const double drove_s = kMargin * ((to.stamp - from.stamp).seconds() + kSlack_s);
  const double way_m = distance_m(from.pose, to.pose);
  const double turn_rad = std::abs(wrap_angle(to.pose.yaw_rad - from.pose.yaw_rad));
  return way_m <= reach_.max_speed_mps * drove_s + kCorrection_m +
                      noise(from.pose.variance_xy_m2, to.pose.variance_xy_m2) &&
         turn_rad <= reach_.max_turn_radps * drove_s + kCorrection_rad +
                         noise(from.pose.variance_yaw_rad2, to.pose.variance_yaw_rad2);
}

SampleGate::Verdict PoseGate::judge(SimTime stamp, const void* record) {
  const Place place{stamp, pose_reading(kind_, static_cast<const std::byte*>(record))};
  const bool finite = is_finite(Pose2{place.pose.x_m, place.pose.y_m, place.pose.yaw_rad});
  if (finite && (!known_ || reaches(good_, place))) {
    known_ = true;
    good_ = place;
    odd_in_a_row_ = 0;
    return Verdict::kPass;
  }
  const bool agrees = finite && odd_in_a_row_ > 0 && reaches(odd_, place);
  if (!agrees) odd_since_ = stamp;
  odd_in_a_row_ = !finite ? 0 : agrees ? odd_in_a_row_ + 1 : 1;
  odd_ = place;
  if (odd_in_a_row_ < kAgreeing || stamp - odd_since_ < kAgreeing_for) return Verdict::kRefuse;
  from_ = good_;
  good_ = place;
  odd_in_a_row_ = 0;
  return Verdict::kAnew;
}

std::string PoseGate::reason() const {
  // After kAnew the last odd place is the good one.
  if (known_ && good_.stamp == odd_.stamp) {
    return fmt::format(
        "its poses are at {} now; the robot cannot have driven there from {} in {:.2f} s",
        text_of(odd_.pose), text_of(from_.pose), (odd_.stamp - from_.stamp).seconds());
  }
  if (!is_finite(Pose2{odd_.pose.x_m, odd_.pose.y_m, odd_.pose.yaw_rad})) {
    return "a pose is not finite";
  }
  return fmt::format(
      "it says {}, but was at {} {:.2f} s before, which {:g} m/s and {:.0f} deg/s do not explain "
      "(`pose_max_speed_mps`, `pose_max_turn_dps`)",
      text_of(odd_.pose), text_of(good_.pose), (odd_.stamp - good_.stamp).seconds(),
      reach_.max_speed_mps, rad_to_deg(reach_.max_turn_radps));
}

void PoseGate::reset() noexcept {
  known_ = false;
  odd_in_a_row_ = 0;
  good_ = from_ = odd_ = {};
}

}  // namespace rave::sim
