// SPDX-License-Identifier: Apache-2.0
// Between ROS 2, which is spatial, and RAVE, whose robots stay level.
#include "rave/ros2/convert.hpp"

#include <algorithm>
#include <limits>

#include "rave/math/scalar.hpp"

namespace rave::ros2 {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

Status check_upright(const char* what, const Attitude& attitude) {
  if (attitude.tilt_rad <= kMostTilt_rad) return {};
  return fail(ErrorCode::kInvalidArgument,
              "{} is tilted by {:.0f} degrees; robots in RAVE stay level", what,
              rad_to_deg(attitude.tilt_rad));
}

}  // namespace

std::int64_t nanoseconds(const Time& time) noexcept {
  return std::int64_t{time.sec} * kSecond_ns + std::int64_t{time.nanosec};
}

Time time_of(std::int64_t nanoseconds) noexcept {
  constexpr std::int64_t kLast =
      std::int64_t{std::numeric_limits<std::int32_t>::max()} * kSecond_ns;
  // Seconds have 32 bits in ROS 2; beyond them time stands still instead of wrapping.
  const std::int64_t held = std::clamp<std::int64_t>(nanoseconds, 0, kLast);
  Time time{};
  time.sec = static_cast<std::int32_t>(held / kSecond_ns);
  time.nanosec = static_cast<std::uint32_t>(held % kSecond_ns);
  return time;
}

Quaternion quaternion_of(double yaw_rad) noexcept {
  const SinCos half = sincos(yaw_rad / 2);
  return {0, 0, half.sin, half.cos};
}

Attitude attitude_of(const Quaternion& q) noexcept {
  // Entries of the rotation matrix; the length of the quaternion cancels out.
  const double x_x = q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z;
  const double y_x = 2 * (q.w * q.z + q.x * q.y);
  const double z_z = q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z;
  const double norm2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  // Yaw is the direction of the x axis seen from above, tilt the angle between both z axes.
  return {wrap_angle(atan2(y_x, x_x)), acos(std::clamp(z_z / norm2, -1.0, 1.0))};
}

Result<Pose2> planar(const Pose& pose) {
  const Attitude attitude = attitude_of(pose.orientation);
  RAVE_TRY(check_upright("the pose", attitude));
  return Pose2{pose.position.x, pose.position.y, attitude.yaw_rad};
}

Result<Pose2> planar(const TransformStamped& transform) {
  const Attitude attitude = attitude_of(transform.transform.rotation);
  RAVE_TRY(check_upright(transform.child_frame_id, attitude));
  const Vector3& translation = transform.transform.translation;
  return Pose2{translation.x, translation.y, attitude.yaw_rad};
}

Pose spatial(const Pose2& pose, double z_m) noexcept {
  return {{pose.x, pose.y, z_m}, quaternion_of(pose.yaw)};
}

}  // namespace rave::ros2
