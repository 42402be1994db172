// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave {

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
  /// A rectangle centred on the origin, length_m along x and width_m along y.
  [[nodiscard]] static Result<ConvexPolygon> box(double length_m, double width_m);

  [[nodiscard]] std::span<const Vec2> vertices() const noexcept { return vertices_; }
  /// The outward unit normal of each edge, edge i leading from vertex i to the next.
  [[nodiscard]] std::span<const Vec2> normals() const noexcept { return normals_; }
  [[nodiscard]] std::size_t size() const noexcept { return vertices_.size(); }

  /// The radius of the smallest disc about `center` that contains the polygon.
  [[nodiscard]] double bounding_radius(Vec2 center = {}) const noexcept;

  /// Whether the point is inside or on the border.
  [[nodiscard]] bool contains(Vec2 point) const noexcept;

 private:
  explicit ConvexPolygon(std::vector<Vec2> vertices);

  std::vector<Vec2> vertices_;
  std::vector<Vec2> normals_;
};

}  // namespace rave
