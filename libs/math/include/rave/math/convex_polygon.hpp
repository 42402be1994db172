// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// The projection of a polygon onto an axis, metres along it.
struct Extent {
  double min = 0;
  double max = 0;
};

/// A convex polygon in a frame of its own: 3 to 64 vertices, counter-clockwise, strictly convex,
/// metres. An immutable value.
class ConvexPolygon {
 public:
  static constexpr std::size_t kMaxVertices = 64;
  /// Larger coordinates are refused, metres.
  static constexpr double kMaxCoordinate_m = 1.0e9;

  /// Makes a polygon from vertices in either sense of rotation; repeated and collinear ones (turn
  /// below 1e-9 rad) are removed. Errors (kInvalidArgument) name vertices and edges by their index
  /// in `vertices`, edge i leading from vertex i to the next: not finite or beyond
  /// kMaxCoordinate_m, fewer than 3 distinct vertices, two edges that cross, area not above 1e-9
  /// m^2, not convex, more than kMaxVertices.
  [[nodiscard]] static Result<ConvexPolygon> make(std::span<const Vec2> vertices);
  /// A regular polygon: n vertices on a circle about the origin, the first on the x axis; n from 3
  /// to 64, radius_m from 1e-4 (a smaller triangle has too little area) to kMaxCoordinate_m.
  [[nodiscard]] static Result<ConvexPolygon> regular(int n, double radius_m);
  /// A rectangle centred on the origin, length_m along x and width_m along y.
  [[nodiscard]] static Result<ConvexPolygon> box(double length_m, double width_m);

  [[nodiscard]] std::span<const Vec2> vertices() const noexcept { return vertices_; }
  /// The outward unit normal of each edge, edge i leading from vertex i to the next.
  [[nodiscard]] std::span<const Vec2> normals() const noexcept { return normals_; }
  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }

  /// Area in m^2.
  [[nodiscard]] double area() const noexcept;
  [[nodiscard]] Vec2 centroid() const noexcept;
  /// The radius of the smallest disc about `center` that contains the polygon.
  [[nodiscard]] double bounding_radius(Vec2 center = {}) const noexcept;

  /// The index of the vertex farthest along `direction`; the lowest of several.
  [[nodiscard]] std::size_t support(Vec2 direction) const noexcept;
  [[nodiscard]] Extent extent(Vec2 direction) const noexcept;

  /// Whether the point is inside or on the border.
  [[nodiscard]] bool contains(Vec2 point) const noexcept;
  /// Distance to the border in metres, negative inside.
  [[nodiscard]] double signed_distance(Vec2 point) const noexcept;
  /// Distance to the polygon in metres; zero inside.
  [[nodiscard]] double distance(Vec2 point) const noexcept;

 private:
  explicit ConvexPolygon(std::vector<Vec2> vertices);

  std::vector<Vec2> vertices_;
  std::vector<Vec2> normals_;
};

/// The distance from `origin` along the unit vector `direction` to the polygon, both in its frame;
/// 0 from inside or the border, +inf if the ray misses. This is the double-precision reference for
/// the faster range kernels.
[[nodiscard]] double cast_ray(Vec2 origin, Vec2 direction, const ConvexPolygon& polygon) noexcept;

}  // namespace rave
