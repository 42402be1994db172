// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "rave/math/pose.hpp"
#include "rave/world/body.hpp"

namespace rave::world {

/// A shape at its place in the world at one time. Its vertices are in an array of the snapshot.
struct PlacedShape {
  std::uint32_t body = 0;
  ShapeKind kind = ShapeKind::kDisc;
  Layer layer = Layer::kVirtualObstacles;
  std::uint32_t first_vertex = 0;
  std::uint32_t vertex_count = 0;
  Vec2 centre_W;        ///< Centre of the bounding disc.
  double radius_m = 0;  ///< Radius of the bounding disc; for kDisc of the disc itself.
  double z0_m = 0;
  double z1_m = 0;

  [[nodiscard]] bool at_height(double z_m) const noexcept { return z_m >= z0_m && z_m <= z1_m; }
};

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Distance from `origin` along the unit vector `direction` to a convex polygon with
/// counter-clockwise vertices; 0 from inside, kNoHit on a miss. The reference for tests of faster
/// kernels: it clips the ray by each half-plane (Cyrus and Beck, 1978).
[[nodiscard]] double cast_polygon(Vec2 origin, Vec2 direction,
                                  std::span<const Vec2> vertices) noexcept;

/// Like cast_polygon(), for a disc.
[[nodiscard]] double cast_disc(Vec2 origin, Vec2 direction, Vec2 centre, double radius_m) noexcept;

}  // namespace rave::world
