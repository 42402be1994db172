// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/ros2/messages.hpp"

/// Conversion between values of ROS 2 and of RAVE. Both follow REP-103; the difference is that RAVE
/// has planar poses. Messages must have passed validate(). Pure; any thread.
namespace rave::ros2 {

/// Nanoseconds since the epoch of the clock that `time` was read from.
[[nodiscard]] std::int64_t nanoseconds(const Time& time) noexcept;
/// The inverse of nanoseconds(). Times before the epoch and after 2038 are clamped.
[[nodiscard]] Time time_of(std::int64_t nanoseconds) noexcept;

/// A rotation about z.
[[nodiscard]] Quaternion quaternion_of(double yaw_rad) noexcept;
/// The heading of the x axis in the plane, in (-pi, pi], and the angle between z and vertical, 0 to
/// pi.
struct Attitude {
  double yaw_rad = 0;
  double tilt_rad = 0;
};
[[nodiscard]] Attitude attitude_of(const Quaternion& rotation) noexcept;

/// A body with a larger tilt is not a vehicle in the plane.
inline constexpr double kMostTilt_rad = 0.35;

/// The projection of a pose onto the plane. Error kInvalidArgument: tilt above kMostTilt_rad.
[[nodiscard]] Result<Pose2> planar(const Pose& pose);
/// The projection of a transform onto the plane: X_AB from frame A (its header) to frame B (its
/// child). Error: as planar(pose).
[[nodiscard]] Result<Pose2> planar(const TransformStamped& transform);
/// The pose in space at height z_m.
[[nodiscard]] Pose spatial(const Pose2& pose, double z_m) noexcept;

}  // namespace rave::ros2
