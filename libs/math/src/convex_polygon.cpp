// SPDX-License-Identifier: Apache-2.0
#include "rave/math/convex_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "rave/math/scalar.hpp"
#include "simple_polygon.hpp"

namespace rave {
ConvexPolygon::ConvexPolygon(std::vector<Vec2> vertices) : vertices_(std::move(vertices)) {
  normals_.reserve(vertices_.size());
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec2 edge = vertices_[(i + 1) % vertices_.size()] - vertices_[i];
    const double length = hypot(edge.x, edge.y);
    // Vertices are counter-clockwise, so outward is the edge turned by -90 degrees.
    normals_.push_back({edge.y / length, -edge.x / length});
  }
}

Result<ConvexPolygon> ConvexPolygon::make(std::span<const Vec2> vertices) {
  // More than kMaxVertices may be given, because vertices on a straight edge are dropped first.
  constexpr std::size_t kMaxGiven = 10'000;
  RAVE_TRY_ASSIGN(auto simple, detail::check_simple(vertices, kMaxGiven));
  simple = detail::without_collinear(std::move(simple));
  const std::size_t n = simple.vertices.size();
  if (n < 3) {
    return fail(ErrorCode::kInvalidArgument, "the vertices of the polygon lie on one line");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 in = simple.vertices[i] - simple.vertices[(i + n - 1) % n];
    const Vec2 out = simple.vertices[(i + 1) % n] - simple.vertices[i];
    if (cross(in, out) <= 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "the polygon is not convex: it turns inwards at vertex {}", simple.source[i]);
    }
  }
  if (n > kMaxVertices) {
    return fail(ErrorCode::kInvalidArgument,
                "a convex polygon has at most {} vertices, this one has {}", kMaxVertices, n);
  }
  return ConvexPolygon(std::move(simple.vertices));
}

Result<ConvexPolygon> ConvexPolygon::box(double length_m, double width_m) {
  if (!(length_m > 0 && width_m > 0)) {
    return fail(ErrorCode::kInvalidArgument,
                "length and width of a box are positive, not {} and {} m", length_m, width_m);
  }
  const double x = 0.5 * length_m;
  const double y = 0.5 * width_m;
  return make(std::array<Vec2, 4>{{{x, -y}, {x, y}, {-x, y}, {-x, -y}}});
}

double ConvexPolygon::bounding_radius(Vec2 center) const noexcept {
  double squared = 0;
  for (const Vec2 v : vertices_) squared = std::max(squared, squared_norm(v - center));
  return std::sqrt(squared);
}

bool ConvexPolygon::contains(Vec2 point) const noexcept {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec2 edge = vertices_[(i + 1) % vertices_.size()] - vertices_[i];
    if (cross(edge, point - vertices_[i]) < 0) return false;
  }
  return true;
}

}  // namespace rave
