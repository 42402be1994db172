// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

#include "rave/base/random.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/math/scalar.hpp"

namespace rave {

inline Pose2 random_pose(RandomStream& random, double reach_m) {
  const double x = random.uniform(-reach_m, reach_m);
  const double y = random.uniform(-reach_m, reach_m);
  return {x, y, random.uniform(-kPi, kPi)};
}

/// 3 to 12 corners on a circle about the origin; never thin, because three of them are fixed.
inline ConvexPolygon random_convex(RandomStream& random, double radius_m) {
  std::vector<double> angles = {0.0, 2.1, 4.2};
  const int extra = static_cast<int>(random.bits() % 10);
  for (int i = 0; i < extra; ++i) angles.push_back(random.uniform(0, 2 * kPi));
  const double start = random.uniform(0, 2 * kPi);
  std::sort(angles.begin(), angles.end());
  std::vector<Vec2> vertices;
  for (const double angle : angles) {
    const SinCos at = sincos(start + angle);
    vertices.push_back({radius_m * at.cos, radius_m * at.sin});
  }
  return ConvexPolygon::make(vertices).value();
}

/// n vertices at evenly growing angles and random distances from 0.3 to 1 m: simple, spiky.
inline std::vector<Vec2> random_star(RandomStream& random, int n) {
  std::vector<Vec2> vertices;
  for (int i = 0; i < n; ++i) {
    const SinCos at = sincos(2 * kPi * i / n);
    const double radius_m = random.uniform(0.3, 1);
    vertices.push_back({radius_m * at.cos, radius_m * at.sin});
  }
  return vertices;
}

}  // namespace rave
