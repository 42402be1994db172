// SPDX-License-Identifier: Apache-2.0
#include "rave/math/convex_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "rave/math/scalar.hpp"
#include "simple_polygon.hpp"

namespace rave {
namespace {

double squared_distance_to_segment(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const Vec2 along = b - a;
  const double share = std::clamp(dot(p - a, along) / squared_norm(along), 0.0, 1.0);
  return squared_norm(p - (a + share * along));
}

}  // namespace

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

Result<ConvexPolygon> ConvexPolygon::regular(int n, double radius_m) {
  if (n < 3 || n > static_cast<int>(kMaxVertices)) {
    return fail(ErrorCode::kInvalidArgument, "a regular polygon has 3 to {} corners, not {}",
                kMaxVertices, n);
  }
  if (!(radius_m >= 1.0e-4 && radius_m <= kMaxCoordinate_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "the radius of a regular polygon is from 0.0001 to {} m, not {}", kMaxCoordinate_m,
                radius_m);
  }
  std::vector<Vec2> vertices;
  for (int i = 0; i < n; ++i) {
    const SinCos angle = sincos(2.0 * kPi * i / n);
    vertices.push_back({radius_m * angle.cos, radius_m * angle.sin});
  }
  return make(vertices);
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

double ConvexPolygon::area() const noexcept { return detail::signed_area(vertices_); }

Vec2 ConvexPolygon::centroid() const noexcept {
  // The mean of the centroids of a fan of triangles about vertex 0, weighted by their areas.
  // Relative to vertex 0, so that no digits are lost for a polygon far from the origin.
  Vec2 sum;
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < vertices_.size(); ++i) {
    const Vec2 u = vertices_[i] - vertices_[0];
    const Vec2 v = vertices_[i + 1] - vertices_[0];
    const double weight = cross(u, v);
    twice_area += weight;
    // The centroid of a triangle is a third of u + v from vertex 0; the third is taken below.
    sum = sum + weight * (u + v);
  }
  return vertices_[0] + (1.0 / (3.0 * twice_area)) * sum;
}

double ConvexPolygon::bounding_radius(Vec2 center) const noexcept {
  double squared = 0;
  for (const Vec2 v : vertices_) squared = std::max(squared, squared_norm(v - center));
  return std::sqrt(squared);
}

std::size_t ConvexPolygon::support(Vec2 direction) const noexcept {
  std::size_t best = 0;
  for (std::size_t i = 1; i < vertices_.size(); ++i) {
    // Of vertices that are equally far the first counts, on every machine.
    if (dot(vertices_[i], direction) > dot(vertices_[best], direction)) best = i;
  }
  return best;
}

Extent ConvexPolygon::extent(Vec2 direction) const noexcept {
  return {dot(vertices_[support(-direction)], direction),
          dot(vertices_[support(direction)], direction)};
}

bool ConvexPolygon::contains(Vec2 point) const noexcept {
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec2 edge = vertices_[(i + 1) % vertices_.size()] - vertices_[i];
    if (cross(edge, point - vertices_[i]) < 0) return false;
  }
  return true;
}

double ConvexPolygon::signed_distance(Vec2 point) const noexcept {
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    depth = std::max(depth, dot(normals_[i], point - vertices_[i]));
  }
  // 0) return depth; <= Inside a convex polygon the nearest edge line is the nearest point of the
  // outline. Outside that may lie beyond the end of the edge, so segments are compared.
  if (depth <= 0) return depth;
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    const Vec2 next = vertices_[(i + 1) % vertices_.size()];
    squared = std::min(squared, squared_distance_to_segment(point, vertices_[i], next));
  }
  return std::sqrt(squared);
}

double ConvexPolygon::distance(Vec2 point) const noexcept {
  return std::max(0.0, signed_distance(point));
}

double cast_ray(Vec2 origin, Vec2 direction, const ConvexPolygon& polygon) noexcept {
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
