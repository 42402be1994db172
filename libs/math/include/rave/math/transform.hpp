// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/pose.hpp"
#include "rave/math/scalar.hpp"

/// Planar rigid transforms. Every yaw returned lies in (-pi, pi]. Pure; any thread; bit-identical
/// on all processors. docs/frames-and-units.md defines the names of frames.
namespace rave {

/// `v` turned counter-clockwise by an angle whose sine and cosine are known.
[[nodiscard]] constexpr Vec2 rotate(SinCos angle, Vec2 v) noexcept {
  return {angle.cos * v.x - angle.sin * v.y, angle.sin * v.x + angle.cos * v.y};
}
/// `v` turned clockwise by that angle.
[[nodiscard]] constexpr Vec2 rotate_back(SinCos angle, Vec2 v) noexcept {
  return {angle.cos * v.x + angle.sin * v.y, angle.cos * v.y - angle.sin * v.x};
}
/// `v` turned counter-clockwise by angle_rad.
[[nodiscard]] inline Vec2 rotate(double angle_rad, Vec2 v) noexcept {
  return rotate(sincos(angle_rad), v);
}

/// p_AP from p_BP: changes the frame of a point from B to A.
[[nodiscard]] inline Vec2 transform(const Pose2& X_AB, Vec2 p_BP) noexcept {
  return X_AB.position() + rotate(X_AB.yaw, p_BP);
}

/// p_BP from p_AP: changes the frame of a point from A to B.
[[nodiscard]] inline Vec2 transform_back(const Pose2& X_AB, Vec2 p_AP) noexcept {
  return rotate_back(sincos(X_AB.yaw), p_AP - X_AB.position());
}

/// X_AC.
[[nodiscard]] inline Pose2 compose(const Pose2& X_AB, const Pose2& X_BC) noexcept {
  const Vec2 p_AC = transform(X_AB, X_BC.position());
  return {p_AC.x, p_AC.y, wrap_angle(X_AB.yaw + X_BC.yaw)};
}

/// X_BA.
[[nodiscard]] inline Pose2 inverse(const Pose2& X_AB) noexcept {
  const Vec2 p_BA = -rotate_back(sincos(X_AB.yaw), X_AB.position());
  return {p_BA.x, p_BA.y, wrap_angle(-X_AB.yaw)};
}

/// The pose at fraction `s` of the way from X_0 (s = 0) to X_1 (s = 1): straight line, shortest
/// turn (counter-clockwise for half a turn). s outside [0, 1] extrapolates.
[[nodiscard]] inline Pose2 interpolate(const Pose2& X_0, const Pose2& X_1, double s) noexcept {
  const double turn_rad = wrap_angle(X_1.yaw - X_0.yaw);
  // Start from the nearer end, so that s = 0 and s = 1 give both ends exactly.
  const double yaw_rad = s < 0.5 ? X_0.yaw + s * turn_rad : X_1.yaw - (1.0 - s) * turn_rad;
  return {(1.0 - s) * X_0.x + s * X_1.x, (1.0 - s) * X_0.y + s * X_1.y, wrap_angle(yaw_rad)};
}

namespace detail {
/// sin(h)/h; its Taylor series near 0, where the quotient is inaccurate.
[[nodiscard]] inline double sinc(double h) noexcept {
  const double z = h * h;
  if (z < 1.0e-4) return 1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0));
  return sin(h) / h;
}
}  // namespace detail

/// The pose after moving for dt_s with the constant body twist v_WB_B: an exact circular arc, a
/// straight line for wz = 0. The chord of the arc points along the mean heading and is sinc(half
/// the turn) times as long as the arc. `turn_WB` must be sincos(X_WB.yaw); callers that already
/// have it save its computation on straight motion.
[[nodiscard]] inline Pose2 integrate(const Pose2& X_WB, const SinCos& turn_WB, const Twist2& v_WB_B,
                                     double dt_s) noexcept {
  const double turn_rad = v_WB_B.wz * dt_s;
  const double half_rad = 0.5 * turn_rad;
  const double scale_s = dt_s * detail::sinc(half_rad);
  const SinCos heading = half_rad == 0 ? turn_WB : sincos(X_WB.yaw + half_rad);
  const Vec2 chord_W = rotate(heading, {scale_s * v_WB_B.vx, scale_s * v_WB_B.vy});
  return {X_WB.x + chord_W.x, X_WB.y + chord_W.y, wrap_angle(X_WB.yaw + turn_rad)};
}
/// Like the above, with the same bits.
[[nodiscard]] inline Pose2 integrate(const Pose2& X_WB, const Twist2& v_WB_B,
                                     double dt_s) noexcept {
  return integrate(X_WB, sincos(X_WB.yaw), v_WB_B, dt_s);
}

/// The constant body twist that leads from X_0 to X_1 in dt_s (not 0) by the shortest turn: the
/// inverse of integrate() for turns within half a revolution.
[[nodiscard]] inline Twist2 twist_between(const Pose2& X_0, const Pose2& X_1,
                                          double dt_s) noexcept {
  const double turn_rad = wrap_angle(X_1.yaw - X_0.yaw);
  const double half_rad = 0.5 * turn_rad;
  const double scale_s = dt_s * detail::sinc(half_rad);
  const Vec2 chord = rotate_back(sincos(X_0.yaw + half_rad), X_1.position() - X_0.position());
  return {chord.x / scale_s, chord.y / scale_s, turn_rad / dt_s};
}

}  // namespace rave
