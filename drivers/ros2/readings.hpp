// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rave/robot/reading.hpp"
#include "rave/ros2/messages.hpp"
#include "ros2/ros2_options.hpp"

/// From messages of ROS 2 to readings. Messages have passed ros2::validate(). Pure; any thread.
namespace rave::ros2_driver {

/// Where the rays of a scanner go, and how far.
struct Fan {
  std::uint32_t rays = 0;
  double first_rad = 0;
  double step_rad = 0;
  double range_min_m = 0;
  double range_max_m = 0;

  friend bool operator==(const Fan&, const Fan&) noexcept = default;
};
[[nodiscard]] Fan fan_of(const ros2::LaserScan& scan) noexcept;
[[nodiscard]] std::vector<double> bearings_of(const Fan& fan);

/// A range as RAVE has it. Beyond the largest range, and 0 where that is no range, is "nothing
/// there" (infinity); too near to be measured, minus infinity included, is the least range; NaN and
/// what is negative is no reading (NaN).
[[nodiscard]] float range_of(float range, double min_m, double max_m) noexcept;
/// Whether any of the ranges of one message is more than NaN, 0 or negative. Where none is, the
/// sensor does not work.
[[nodiscard]] bool says_something(std::span<const float> ranges) noexcept;
/// All of a scan. Error kInvalidArgument: the scanner is not the one that the fan is of, or it says
/// nothing.
[[nodiscard]] Status ranges_of(const ros2::LaserScan& scan, const Fan& fan,
                               std::span<float> ranges_m);

/// Errors of these: what leans too much.
[[nodiscard]] Result<OdometryReading> odometry_of(const ros2::Odometry& message,
                                                  const Doubt& doubt);
[[nodiscard]] Result<PoseReading> pose_of(const ros2::Odometry& message, const Doubt& doubt);
[[nodiscard]] Result<PoseReading> pose_of(const ros2::PoseStamped& message, const Doubt& doubt);
[[nodiscard]] std::array<double, 10> imu_values(const ros2::Imu& message) noexcept;
[[nodiscard]] std::array<double, 6> battery_values(const ros2::BatteryState& message) noexcept;

}  // namespace rave::ros2_driver
