// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rave/robot/reading.hpp"
#include "rave/ros2/messages.hpp"
#include "ros2/ros2_options.hpp"

/// Converts messages of ROS 2 to readings. Messages must have passed ros2::validate(). Pure; any
/// thread.
namespace rave::ros2_driver {

/// The rays of a scanner and their limits.
struct Fan {
  std::uint32_t rays = 0;
  double first_rad = 0;
  double step_rad = 0;
  double range_min_m = 0;
  double range_max_m = 0;
};
[[nodiscard]] Fan fan_of(const ros2::LaserScan& scan) noexcept;
[[nodiscard]] std::vector<double> bearings_of(const Fan& fan);

/// What a range of exactly 0 means, which REP-117 leaves out.
enum class Zero : std::uint8_t { kNoReading, kNoReturn };

/// Converts a range. Above the maximum: no return (infinity). Below the minimum, minus infinity
/// included: the minimum. NaN and negative: no reading (NaN).
[[nodiscard]] float range_of(float range, double min_m, double max_m,
                             Zero zero = Zero::kNoReading) noexcept;
/// Whether any range of a message is valid, that is not NaN, 0 or negative. If none is, the sensor
/// is faulty.
[[nodiscard]] bool says_something(std::span<const float> ranges) noexcept;
/// Converts a scan, whose rays may be others than those of `fan`, by number and direction: each ray
/// of the fan gets the reading of the nearest one of the scan. NaN if there is none within half a
/// spacing: that of the fan, or of the scan, but no more than twice that of the fan. Error
/// kInvalidArgument: that holds for more than half of the rays, or no range is valid.
[[nodiscard]] Status ranges_of(const ros2::LaserScan& scan, const Fan& fan,
                               std::span<float> ranges_m, Zero zero = Zero::kNoReading);

/// Errors: tilt above the limit, see ros2::planar().
[[nodiscard]] Result<OdometryReading> odometry_of(const ros2::Odometry& message,
                                                  const Doubt& doubt);
[[nodiscard]] Result<PoseReading> pose_of(const ros2::Odometry& message, const Doubt& doubt);
[[nodiscard]] Result<PoseReading> pose_of(const ros2::PoseStamped& message, const Doubt& doubt);
[[nodiscard]] std::array<double, 10> imu_values(const ros2::Imu& message) noexcept;
[[nodiscard]] std::array<double, 6> battery_values(const ros2::BatteryState& message) noexcept;

}  // namespace rave::ros2_driver
