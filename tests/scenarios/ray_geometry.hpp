// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/polygon.hpp"
#include "rave/math/transform.hpp"
#include "rave/math_testing/polygon_measures.hpp"
#include "rave/sim/engine.hpp"

namespace rave::tests {

/// The distance along a ray to a body that stands at X_WB, metres, by reference functions
/// that share nothing with the range engine; +infinity if it misses.
inline double ray_to_body(const world::WorldModel& world, std::uint32_t body, const Pose2& X_WB,
                          Vec2 p_W, double yaw_rad) {
  const Vec2 origin = transform_back(X_WB, p_W);
  const SinCos turn = sincos(yaw_rad - X_WB.yaw);
  const Vec2 direction{turn.cos, turn.sin};
  double nearest = std::numeric_limits<double>::infinity();
  for (const world::Shape& shape : world.body(body).shapes) {
    double range = std::numeric_limits<double>::infinity();
    if (shape.polygon) {
      range = cast_ray(origin, direction, *shape.polygon);
    } else {
      const Vec2 m = shape.centre - origin;
      const double along = dot(m, direction);
      const double root = shape.radius_m * shape.radius_m - squared_norm(m) + along * along;
      if (root >= 0 && along >= 0) range = along - std::sqrt(root);
    }
    nearest = std::min(nearest, range);
  }
  return nearest;
}

}  // namespace rave::tests
