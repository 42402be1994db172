// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "rave/math/convex_polygon.hpp"
#include "rave/math/scalar.hpp"

// What tests measure of convex polygons; it shares nothing with the code under test.
namespace rave {

/// n vertices on a circle about the origin, the first on the x axis.
inline ConvexPolygon regular_polygon(int n, double radius_m) {
  std::vector<Vec2> vertices;
  for (int i = 0; i < n; ++i) {
    const SinCos angle = sincos(2.0 * kPi * i / n);
    vertices.push_back({radius_m * angle.cos, radius_m * angle.sin});
  }
  return ConvexPolygon::make(vertices).value();
}

/// Area in m^2.
inline double area(const ConvexPolygon& polygon) {
  const auto vertices = polygon.vertices();
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice_area += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  }
  return 0.5 * twice_area;
}

/// Distance to the border in metres, negative inside.
inline double signed_distance(const ConvexPolygon& polygon, Vec2 point) {
  const auto vertices = polygon.vertices();
  double depth = -std::numeric_limits<double>::infinity();
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 a = vertices[i];
    const Vec2 along = vertices[(i + 1) % vertices.size()] - a;
    depth = std::max(depth, dot(polygon.normals()[i], point - a));
    const double share = std::clamp(dot(point - a, along) / squared_norm(along), 0.0, 1.0);
    squared = std::min(squared, squared_norm(point - (a + share * along)));
  }
  // Inside, the nearest edge line is the nearest point of the outline; outside, it may lie beyond
  // the end of the edge.
  return depth <= 0 ? depth : std::sqrt(squared);
}

/// Distance to the polygon in metres; zero inside.
inline double distance_to(const ConvexPolygon& polygon, Vec2 point) {
  return std::max(0.0, signed_distance(polygon, point));
}

/// The distance from `origin` along the unit vector `direction` to the polygon, both in its frame;
/// 0 from inside or the border, +inf if the ray misses.
inline double cast_ray(Vec2 origin, Vec2 direction, const ConvexPolygon& polygon) {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  // Clipping by half planes (M. Cyrus, J. Beck, Generalized two- and three-dimensional clipping,
  // Computers & Graphics 3, 1978). An origin inside gives 0.
  double enter = 0;
  double leave = kMiss;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 normal = polygon.normals()[i];
    const double ahead = dot(normal, polygon.vertices()[i] - origin);
    const double speed = dot(normal, direction);
    if (speed < 0) {
      enter = std::max(enter, ahead / speed);
    } else if (speed > 0) {
      leave = std::min(leave, ahead / speed);
      // Parallel to an edge, and on its outer side all along.
    } else if (ahead < 0) {
      return kMiss;
    }
  }
  return enter <= leave ? enter : kMiss;
}

}  // namespace rave
