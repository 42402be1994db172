// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// A displacement within one step: the origin of the body moves in a straight line in W while the
/// yaw changes uniformly. Metres and radians; `dyaw` may exceed half a revolution and is not
/// wrapped.
struct Motion2 {
  double dx = 0;
  double dy = 0;
  double dyaw = 0;
};

/// The pose of A after the fraction `fraction` of its motion.
[[nodiscard]] Pose2 advance(const Pose2& X_WA, const Motion2& motion_W, double fraction) noexcept;

/// The result of time_of_impact().
struct Impact {
  /// The fraction of the motion that is free of contact, in [0, 1].
  double fraction = 1;
  /// Unit vector from A to B in W, at `fraction` of the motion.
  Vec2 normal_W;
  /// The signed separation at `fraction`, metres.
  double distance_m = 0;
  /// False if the whole motion is free.
  bool hit = false;
};

/// The distances that time_of_impact() keeps.
struct ImpactLimits {
  /// The separation that is kept, metres.
  double skin_m = 1.0e-4;
  /// A contact is reported at a separation between skin_m and skin_m + tolerance_m, metres (> 0).
  double tolerance_m = 1.0e-6;
};

/// The largest fraction of the motion of polygon `a` from X_WA during which its separation from
/// polygon `b`, fixed at X_WB, stays at least the skin. If they start nearer than that (or
/// overlap), the separation must not shrink: moving apart and sliding are free, any other motion
/// gives fraction 0. The motion never tunnels through a body, however thin or fast (conservative
/// advancement; Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, with
/// second-order steps per vertex). All numbers must be finite. After 200 undecided steps the
/// fraction proven free is returned as a hit.
[[nodiscard]] Impact time_of_impact(const ConvexPolygon& a, const Pose2& X_WA,
                                    const Motion2& motion_W, const ConvexPolygon& b,
                                    const Pose2& X_WB, const ImpactLimits& limits = {}) noexcept;

}  // namespace rave
