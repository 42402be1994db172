// SPDX-License-Identifier: Apache-2.0
#include "ros2/readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "rave/bus/sequence.hpp"
#include "rave/math/scalar.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr float kNoReading = std::numeric_limits<float>::quiet_NaN();
constexpr float kNothing = std::numeric_limits<float>::infinity();

/// Indices of x, y and heading in a 6x6 covariance.
constexpr std::size_t kXX = 0;
constexpr std::size_t kYY = 7;
constexpr std::size_t kYawYaw = 35;

/// Many nodes leave the covariance at zero, which no real sensor has; the parameters apply then.
Doubt doubt_of(std::span<const double, 36> covariance, const Doubt& otherwise) {
  // One number represents both axes: the larger one, which does not understate the uncertainty.
  const double xy = std::max(covariance[kXX], covariance[kYY]);
  return {xy > 0 ? xy : otherwise.variance_xy_m2,
          covariance[kYawYaw] > 0 ? covariance[kYawYaw] : otherwise.variance_yaw_rad2};
}

PoseReading reading(const Pose2& pose, const Doubt& doubt) {
  return {pose.x, pose.y, pose.yaw, doubt.variance_xy_m2, doubt.variance_yaw_rad2};
}

/// The rays of one message, found by their directions.
class Rays {
 public:
  Rays(const Fan& here, const Fan& wanted) noexcept : fan_(here) {
    const double wanted_rad = wanted.rays > 1 ? std::abs(wanted.step_rad) : kLeastSpacing_rad;
    const double here_rad = here.rays > 1 ? std::abs(here.step_rad) : wanted_rad;
    step_rad_ = here.rays > 1 ? here.step_rad : 2 * kPi;
    half_rad_ = 0.5 * std::clamp(here_rad, wanted_rad, 2 * wanted_rad) * (1 + kRounding);
  }
  /// The one nearest to a direction, if it is near enough.
  [[nodiscard]] std::optional<std::size_t> at(double bearing_rad) const noexcept {
    const double last = fan_.rays - 1;
    const double turn = 2 * kPi / std::abs(step_rad_);
    double place = (bearing_rad - fan_.first_rad) / step_rad_;
    // Scanners that turn write the same direction as -pi and as pi.
    place -= turn * std::round((place - last / 2) / turn);
    const double nearest = std::clamp(std::round(place), 0.0, last);
    if (std::abs(place - nearest) * std::abs(step_rad_) > half_rad_) return std::nullopt;
    return static_cast<std::size_t>(nearest);
  }

 private:
  /// Of a fan with a single ray.
  static constexpr double kLeastSpacing_rad = 1e-3;
  /// Angles of messages have single precision.
  static constexpr double kRounding = 1e-3;

  Fan fan_;
  double step_rad_ = 0;
  double half_rad_ = 0;
};

}  // namespace

Fan fan_of(const ros2::LaserScan& scan) noexcept {
  return {scan.ranges._length, scan.angle_min, scan.angle_increment, scan.range_min,
          scan.range_max};
}

std::vector<double> bearings_of(const Fan& fan) {
  std::vector<double> bearings_rad;
  for (std::uint32_t i = 0; i < fan.rays; ++i) {
    bearings_rad.push_back(fan.first_rad + fan.step_rad * i);
  }
  return bearings_rad;
}

float range_of(float range, double min_m, double max_m, Zero zero) noexcept {
  if (range == 0) return zero == Zero::kNoReturn ? kNothing : kNoReading;
  // REP-117: -infinity is "too close", +infinity "no return", NaN an invalid measurement.
  if (std::isnan(range) || (range < 0 && range != -kNothing)) return kNoReading;
  if (range > max_m) return kNothing;
  return range < min_m ? static_cast<float>(min_m) : range;
}

// A scanner whose motor has stopped keeps publishing. Such scans must count as silence, or the
// guard would take them for free space.
bool says_something(std::span<const float> ranges) noexcept {
  return std::ranges::any_of(ranges, [](float range) { return range > 0 || range == -kNothing; });
}

Status ranges_of(const ros2::LaserScan& scan, const Fan& fan, std::span<float> ranges_m,
                 Zero zero) {
  const std::span<const float> said = bus::elements(scan.ranges);
  if (!says_something(said)) {
    return fail(ErrorCode::kInvalidArgument,
                "no ray has a valid reading: all are NaN, 0 or negative, as if the scanner did not "
                "turn; no return is +infinity (REP-117)");
  }
  const Rays rays(fan_of(scan), fan);
  std::uint32_t met = 0;
  for (std::uint32_t i = 0; i < fan.rays; ++i) {
    const auto ray = rays.at(fan.first_rad + fan.step_rad * i);
    met += ray ? 1U : 0U;
    if (!ray) {
      ranges_m[i] = kNoReading;
      continue;
    }
    const float range_m = range_of(said[*ray], scan.range_min, scan.range_max, zero);
    // Some scanners change their limits, but the first ones are what everybody was told.
    ranges_m[i] = range_of(range_m, fan.range_min_m, fan.range_max_m);
  }
  if (2 * met >= fan.rays) return {};
  const Fan here = fan_of(scan);
  return fail(ErrorCode::kInvalidArgument,
              "the scanner has changed: {} rays from {:.4f} rad with spacing {:.5f} rad, instead "
              "of {} from {:.4f} rad with spacing {:.5f} rad; restart the run",
              here.rays, here.first_rad, here.step_rad, fan.rays, fan.first_rad, fan.step_rad);
}

Result<OdometryReading> odometry_of(const ros2::Odometry& message, const Doubt& doubt) {
  RAVE_TRY_ASSIGN(const Pose2 pose, ros2::planar(message.pose.pose));
  const Doubt said = doubt_of(message.pose.covariance, doubt);
  // The twist of the message is in the frame of the body (`child_frame_id`), as RAVE needs it.
  return OdometryReading{pose.x,
                         pose.y,
                         pose.yaw,
                         message.twist.twist.linear.x,
                         message.twist.twist.angular.z,
                         said.variance_xy_m2,
                         said.variance_yaw_rad2};
}

Result<PoseReading> pose_of(const ros2::Odometry& message, const Doubt& doubt) {
  RAVE_TRY_ASSIGN(const Pose2 pose, ros2::planar(message.pose.pose));
  return reading(pose, doubt_of(message.pose.covariance, doubt));
}

Result<PoseReading> pose_of(const ros2::PoseStamped& message, const Doubt& doubt) {
  RAVE_TRY_ASSIGN(const Pose2 pose, ros2::planar(message.pose));
  return reading(pose, doubt);
}

std::array<double, 10> imu_values(const ros2::Imu& message) noexcept {
  std::array<double, 10> values{};
  values.fill(kUnknown);
  // By convention of sensor_msgs/Imu, -1 there marks a value that the device does not measure.
  if (message.orientation_covariance[0] != -1) {
    const ros2::Quaternion& q = message.orientation;
    std::ranges::copy(std::array{q.x, q.y, q.z, q.w}, values.begin());
  }
  if (message.angular_velocity_covariance[0] != -1) {
    const ros2::Vector3& v = message.angular_velocity;
    std::ranges::copy(std::array{v.x, v.y, v.z}, values.begin() + 4);
  }
  if (message.linear_acceleration_covariance[0] != -1) {
    const ros2::Vector3& v = message.linear_acceleration;
    std::ranges::copy(std::array{v.x, v.y, v.z}, values.begin() + 7);
  }
  return values;
}

std::array<double, 6> battery_values(const ros2::BatteryState& message) noexcept {
  return {message.percentage, message.voltage,  message.current,
          message.charge,     message.capacity, message.temperature};
}

}  // namespace rave::ros2_driver
