// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/math/pose.hpp"

namespace rave {

/// A direction to drive in, and how far that is free.
struct FreeHeading {
  double heading_rad = 0;  ///< In the robot's frame, (-pi, pi].
  double free_m = 0;       ///< Up to the look-ahead distance.
};

/// Chooses among directions around the robot by the obstacle points that it knows, as VFH+ does:
/// I. Ulrich, J. Borenstein, "VFH+: Reliable Obstacle Avoidance for Fast Mobile Robots", ICRA 1998;
/// with the points themselves instead of a histogram, so nothing depends on a sector size.
/// A value; all calls are pure.
class Steering {
 public:
  Steering() = default;
  /// half_width_m: of the corridor that must be free: the body's radius and a margin.
  /// look_m: how far ahead it must be free.
  Steering(double half_width_m, double look_m) : half_width_m_(half_width_m), look_m_(look_m) {}

  /// How far a disc of the half width can go along `heading_rad` before it touches a point, at
  /// most `look_m`. 0 if it touches one that lies ahead; points behind do not count.
  [[nodiscard]] double free_m(std::span<const Vec2> points_R, double heading_rad,
                              double look_m) const noexcept;

  /// The free direction that is best by |turn from wanted| + 0.3 |turn from ahead|; if none is
  /// free, the one that is free farthest. Free means up to `look_m`, for instance the distance to a
  /// goal, but no more than the look-ahead distance.
  [[nodiscard]] FreeHeading best(std::span<const Vec2> points_R, double wanted_rad,
                                 double look_m) const noexcept;

  /// The first free direction from `from_rad` on, turning counter-clockwise (side = 1) or clockwise
  /// (side = -1): a hand kept on the wall. If none is free, the one that is free farthest.
  [[nodiscard]] FreeHeading first(std::span<const Vec2> points_R, double from_rad, int side,
                                  double look_m) const noexcept;

 private:
  double half_width_m_ = 0;
  double look_m_ = 0;
};

}  // namespace rave
