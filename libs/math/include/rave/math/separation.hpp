// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// The separation of two shapes A and B.
struct Separation {
  /// Distance between the nearest points in metres; if the shapes overlap, minus the length of the
  /// shortest translation that separates them.
  double distance_m = 0;
  /// Unit vector from A to B in W: moving B along it separates them.
  Vec2 normal_W;
  /// The witness points, on A and on B: p_WB = p_WA + distance_m * normal_W.
  Vec2 p_WA;
  Vec2 p_WB;
};

/// Signed separation of polygon `a` at X_WA and polygon `b` at X_WB: all edge normals are tried
/// (separating axis theorem), then the nearest vertices. Of equally good axes the first of a wins,
/// then the first of b. Bit-identical on all processors. No allocation; any thread.
[[nodiscard]] Separation distance(const ConvexPolygon& a, const Pose2& X_WA, const ConvexPolygon& b,
                                  const Pose2& X_WB) noexcept;

/// Like the above, for polygon `a` and a disc B of radius_m >= 0 about p_WC.
[[nodiscard]] Separation distance(const ConvexPolygon& a, const Pose2& X_WA, Vec2 p_WC,
                                  double radius_m) noexcept;

}  // namespace rave
