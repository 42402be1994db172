// SPDX-License-Identifier: Apache-2.0
// Rays against single shapes, exactly and in double precision, for queries that are few.
#include "rave/world/placed_shape.hpp"

#include <cmath>

namespace rave::world {

// Clipping of the ray by the half planes of the edges (M. Cyrus and J. Beck, Computers & Graphics
// 3, 1978). Normals need no unit length: distance and speed have the same factor.
double cast_polygon(Vec2 origin, Vec2 direction, std::span<const Vec2> vertices) noexcept {
  double enter = 0;
  double leave = kNoHit;
  bool inside = true;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 a = vertices[i];
    const Vec2 edge = vertices[i + 1 == vertices.size() ? 0 : i + 1] - a;
    const Vec2 outward{edge.y, -edge.x};
    const double distance = dot(outward, a - origin);  // negative: outside this edge
    const double speed = dot(outward, direction);
    if (distance < 0) inside = false;
    // Parallel to this edge: outside it for its whole length, or not limited by it.
    if (speed == 0) {
      if (distance < 0) return kNoHit;
      continue;
    }
    const double t = distance / speed;
    if (speed < 0) {
      enter = t > enter ? t : enter;
    } else {
      leave = t < leave ? t : leave;
    }
  }
  if (inside) return 0;
  return enter <= leave ? enter : kNoHit;
}

double cast_disc(Vec2 origin, Vec2 direction, Vec2 centre, double radius_m) noexcept {
  const Vec2 m = centre - origin;
  const double along = dot(m, direction);
  const double apart = squared_norm(m) - radius_m * radius_m;
  if (apart <= 0) return 0;
  if (along <= 0) return kNoHit;
  // The distance of the centre from the line by the cross product: no cancellation far away.
  const double aside = cross(m, direction);
  const double root = radius_m * radius_m - aside * aside;
  if (root < 0) return kNoHit;
  return along - std::sqrt(root);
}

}  // namespace rave::world
