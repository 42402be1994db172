// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/math/pose.hpp"

namespace rave {

/// A heading, and the free distance along it.
struct FreeHeading {
  double heading_rad = 0;  ///< In the robot frame, (-pi, pi].
  double free_m = 0;       ///< At most the look-ahead distance.
};

/// Selects a heading from obstacle points around the robot, like VFH+: I. Ulrich, J. Borenstein,
/// "VFH+: Reliable Obstacle Avoidance for Fast Mobile Robots", ICRA 1998. It uses the points
/// instead of a histogram, so the result does not depend on a sector size. A value; all calls are
/// pure.
class Steering {
 public:
  Steering() = default;
  /// half_width_m: half the width of the corridor that must be free, usually the body's radius and
  /// a margin. look_m: look-ahead distance.
  Steering(double half_width_m, double look_m) : half_width_m_(half_width_m), look_m_(look_m) {}

  /// The distance that a disc with the half width can move along `heading_rad` before it touches a
  /// point, at most `look_m`. 0 if it already touches a point ahead; points behind are ignored.
  [[nodiscard]] double free_m(std::span<const Vec2> points_R, double heading_rad,
                              double look_m) const noexcept;

  /// The free heading with the least cost |turn from wanted| + 0.3 |turn from ahead|; if none is
  /// free, the one with the largest free distance. Free means over `look_m`, for example the
  /// distance to a goal, but no more than the look-ahead distance.
  [[nodiscard]] FreeHeading best(std::span<const Vec2> points_R, double wanted_rad,
                                 double look_m) const noexcept;

  /// The first free heading from `from_rad` on, turning counter-clockwise (side = 1) or clockwise
  /// (side = -1), for wall following. If none is free, the one with the largest free distance.
  [[nodiscard]] FreeHeading first(std::span<const Vec2> points_R, double from_rad, int side,
                                  double look_m) const noexcept;

 private:
  double half_width_m_ = 0;
  double look_m_ = 0;
};

}  // namespace rave
