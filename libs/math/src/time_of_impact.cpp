// SPDX-License-Identifier: Apache-2.0
#include "rave/math/time_of_impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "placed_polygon.hpp"

namespace rave {
namespace {

/// Tolerance of a motion for rounding errors, metres: without it a body on a wall could not slide
/// along it. A million steps lose a micrometre, a hundredth of the usual skin.
constexpr double kSlack_m = 1.0e-12;
constexpr int kMaxSteps = 200;

/// The first fraction s > 0 at which room - approach * s - bend * s^2 becomes negative, for room
/// and bend >= 0; +inf if it never does.
double share_until_used_up(double room, double approach, double bend) noexcept {
  const double root = std::sqrt(approach * approach + 4.0 * bend * room);
  if (approach > 0) return 2.0 * room / (approach + root);
  if (bend > 0) return (root - approach) / (2.0 * bend);
  return std::numeric_limits<double>::infinity();
}

/// The fraction of the motion during which every vertex of `a` keeps the distance `target` from the
/// line through b's nearest point perpendicular to `axis`. A turn by theta moves a vertex with arm
/// r along the axis by (r x axis) sin theta - (r . axis)(1 - cos theta). The bound for |theta| <=
/// pi/2 uses 2/pi |theta| <= |sin theta| <= |theta| and 0 <= 1 - cos theta <= theta^2 / 2.
double free_share(const detail::PlacedPolygon& a, Vec2 origin, const Motion2& motion,
                  const Separation& now, double target) noexcept {
  const Vec2 axis = now.normal_W;
  const double limit = dot(axis, now.p_WB) - target;
  const double straight = dot(axis, {motion.dx, motion.dy});
  double share = motion.dyaw == 0 ? std::numeric_limits<double>::infinity()
                                  : 0.5 * kPi / std::abs(motion.dyaw);
  for (std::size_t i = 0; i < a.count; ++i) {
    const Vec2 arm = a.vertex(i) - origin;
    const double room = std::max(0.0, limit - dot(axis, a.vertex(i)));
    const double turning = motion.dyaw * cross(arm, axis);
    const double approach = straight + (turning > 0 ? turning : turning * (2.0 / kPi));
    const double bend = 0.5 * motion.dyaw * motion.dyaw * std::max(0.0, -dot(arm, axis));
    share = std::min(share, share_until_used_up(room, approach, bend));
  }
  return share;
}

}  // namespace

Pose2 advance(const Pose2& X_WA, const Motion2& motion_W, double fraction) noexcept {
  return {X_WA.x + fraction * motion_W.dx, X_WA.y + fraction * motion_W.dy,
          wrap_angle(X_WA.yaw + fraction * motion_W.dyaw)};
}

Impact time_of_impact(const ConvexPolygon& a, const Pose2& X_WA, const Motion2& motion_W,
                      const ConvexPolygon& b, const Pose2& X_WB,
                      const ImpactLimits& limits) noexcept {
  // Relative to the origin of B, as in distance().
  const Pose2 start{X_WA.x - X_WB.x, X_WA.y - X_WB.y, X_WA.yaw};
  detail::PlacedPolygon placed_a;
  detail::PlacedPolygon placed_b;
  placed_b.place(b, sincos(X_WB.yaw), {});
  const auto separation_at = [&](double fraction) {
    const Pose2 pose = advance(start, motion_W, fraction);
    placed_a.place(a, sincos(pose.yaw), pose.position());
    return detail::separate(placed_a, placed_b);
  };

  double fraction = 0;
  Separation now = separation_at(0);
  const double target = std::min(limits.skin_m, now.distance_m) - kSlack_m;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vec2 origin = advance(start, motion_W, fraction).position();
    const double share = free_share(placed_a, origin, motion_W, now, target);
    if (fraction + share >= 1.0) {
      now = separation_at(1.0);
      return {1.0, now.normal_W, now.distance_m, false};
    }
    // The remaining room is negligible, and so is the gain of further steps.
    constexpr double kSmallShare = 1.0e-3;
    const bool close = now.distance_m - target <= limits.tolerance_m;
    if (close && share <= kSmallShare) return {fraction, now.normal_W, now.distance_m, true};
    fraction += share;
    now = separation_at(fraction);
  }
  return {fraction, now.normal_W, now.distance_m, true};
}

}  // namespace rave
