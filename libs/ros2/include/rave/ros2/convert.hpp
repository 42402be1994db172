// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/ros2/messages.hpp"

/// Between the values of ROS 2 and those of RAVE. Both follow REP-103, so only shapes differ: RAVE
/// has poses in the plane. Messages must have passed validate(). Pure; any thread.
namespace rave::ros2 {

/// Nanoseconds since the epoch of the clock that the time was read from.
[[nodiscard]] std::int64_t nanoseconds(const Time& time) noexcept;
/// Times before the epoch and after the year 2038 are cut off there.
[[nodiscard]] Time time_of(std::int64_t nanoseconds) noexcept;

/// A turn about z alone.
[[nodiscard]] Quaternion quaternion_of(double yaw_rad) noexcept;
/// The heading of the x axis in the plane, in (-pi, pi], and how far z is from upright, 0 to pi.
struct Attitude {
  double yaw_rad = 0;
  double tilt_rad = 0;
};
[[nodiscard]] Attitude attitude_of(const Quaternion& rotation) noexcept;

/// Something that leans more than this is no vehicle in the plane.
inline constexpr double kMostTilt_rad = 0.35;

/// The pose from above. Error kInvalidArgument: it leans more than kMostTilt_rad.
[[nodiscard]] Result<Pose2> planar(const Pose& pose);
/// X_AB of a transform from frame A (its header) to frame B (its child), from above; the same
/// error.
[[nodiscard]] Result<Pose2> planar(const TransformStamped& transform);
/// At the height z_m.
[[nodiscard]] Pose spatial(const Pose2& pose, double z_m) noexcept;

}  // namespace rave::ros2
