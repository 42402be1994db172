// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "rave/math/pose.hpp"

namespace rave::sim {

/// A drive of the middle of a disc: the arc of a twist from a pose, so long.
struct GuardPath {
  Pose2 X_WR;
  Twist2 drive;  ///< In the frame of the robot.
  double length_m = 0;

  [[nodiscard]] Pose2 at(double s_m) const noexcept;
  /// Radius of the circle that it is an arc of; infinite: none.
  [[nodiscard]] double circle_m() const noexcept;
};

/// Distance from a point to the border of a simple polygon: positive inside, negative outside.
[[nodiscard]] double inside_distance(std::span<const Vec2> fence_W, Vec2 p_W) noexcept;

/// Whether a disc may drive a path: it must stay inside the fence; one that is not all inside must
/// come further inside all the way, until it is.
[[nodiscard]] bool stays_inside(std::span<const Vec2> fence_W, const GuardPath& path,
                                double radius_m) noexcept;

}  // namespace rave::sim
