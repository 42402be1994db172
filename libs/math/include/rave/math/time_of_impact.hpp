// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// A displacement within one step: the origin of the body moves in a straight line in W while the
/// yaw changes evenly. Metres and radians; turns of more than half a revolution are meant as such.
struct Motion2 {
  double dx = 0;
  double dy = 0;
  double dyaw = 0;
};

/// The pose of A after the share `fraction` of its motion.
[[nodiscard]] Pose2 advance(const Pose2& X_WA, const Motion2& motion_W, double fraction) noexcept;

/// How far a motion may go.
struct Impact {
  /// The share of the motion that is free, in [0, 1].
  double fraction = 1;
  /// The unit vector from A to B where the motion ends (at fraction).
  Vec2 normal_W;
  /// The signed separation there, metres.
  double distance_m = 0;
  /// False if the whole motion is free.
  bool hit = false;
};

/// How near a body may come.
struct ImpactLimits {
  /// The separation that is kept, metres.
  double skin_m = 1.0e-4;
  /// A contact is reported at a separation between the skin and this much more, metres (> 0).
  double tolerance_m = 1.0e-6;
};

/// The largest share of the motion of polygon `a` from X_WA during which its separation from
/// polygon `b`, fixed at X_WB, stays at least the skin. If they start nearer than that (or
/// overlap), the separation must not shrink: moving apart and sliding are free, anything else
/// yields fraction 0. Never steps over anything, however thin or fast (conservative advancement;
/// Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, with second-order steps
/// per vertex). All numbers must be finite. After 200 steps without a decision the share proven
/// free is returned as a hit.
[[nodiscard]] Impact time_of_impact(const ConvexPolygon& a, const Pose2& X_WA,
                                    const Motion2& motion_W, const ConvexPolygon& b,
                                    const Pose2& X_WB, const ImpactLimits& limits = {}) noexcept;

}  // namespace rave
