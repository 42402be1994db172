// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave {

/// A point or free vector in the plane, metres (or metres per second). The name of a variable gives
/// its frame: `p_WR` is the position of R in W. See docs/frames-and-units.md.
struct Vec2 {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(Vec2, Vec2) noexcept = default;
  friend constexpr Vec2 operator+(Vec2 a, Vec2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(Vec2 a, Vec2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator-(Vec2 a) noexcept { return {-a.x, -a.y}; }
  friend constexpr Vec2 operator*(double s, Vec2 a) noexcept { return {s * a.x, s * a.y}; }
};

/// The dot product.
[[nodiscard]] constexpr double dot(Vec2 a, Vec2 b) noexcept { return a.x * b.x + a.y * b.y; }
/// The z component of the cross product: positive if b is counter-clockwise of a.
[[nodiscard]] constexpr double cross(Vec2 a, Vec2 b) noexcept { return a.x * b.y - a.y * b.x; }
/// The square of the length.
[[nodiscard]] constexpr double squared_norm(Vec2 a) noexcept { return dot(a, a); }

/// A planar pose (`X_WB`: of body B in frame W). REP-103: x forward, y left, yaw counter-clockwise
/// from x. Metres and radians; code that integrates yaw keeps it in (-pi, pi].
struct Pose2 {
  double x = 0;
  double y = 0;
  double yaw = 0;

  [[nodiscard]] constexpr Vec2 position() const noexcept { return {x, y}; }
  friend constexpr bool operator==(const Pose2&, const Pose2&) noexcept = default;
};

/// A planar velocity. `v_WB_B` is the velocity of B in W, expressed in B. m/s and rad/s.
struct Twist2 {
  double vx = 0;
  double vy = 0;
  double wz = 0;

  friend constexpr bool operator==(const Twist2&, const Twist2&) noexcept = default;
};

}  // namespace rave
