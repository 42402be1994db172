// SPDX-License-Identifier: Apache-2.0
#include "rave/math/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "placed_polygon.hpp"
#include "rave/math/transform.hpp"

namespace rave {
namespace detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The edge of one polygon with the largest distance to the other polygon.
struct FaceQuery {
  double distance = -kInfinity;
  std::size_t edge = 0;
};

FaceQuery best_face(const PlacedPolygon& face, const PlacedPolygon& other) noexcept {
  FaceQuery best;
  for (std::size_t i = 0; i < face.count; ++i) {
    const Vec2 normal = face.normal(i);
    double nearest = dot(normal, other.vertex(0));
    for (std::size_t j = 1; j < other.count; ++j) {
      nearest = std::min(nearest, dot(normal, other.vertex(j)));
    }
    const double distance = nearest - dot(normal, face.vertex(i));
    if (distance > best.distance) best = {distance, i};
  }
  return best;
}

/// The part of the edge, in metres from its first vertex, opposite the nearest vertices of the
/// other. Empty (low > high) if the nearest points are not perpendicular to the edge.
struct Overlap {
  double low = 0;
  double high = 0;
};

Overlap facing_part(const PlacedPolygon& face, const FaceQuery& query,
                    const PlacedPolygon& other) noexcept {
  // Vertices this close to the nearest one count as parallel to the edge, metres.
  constexpr double kParallel_m = 1.0e-9;
  const Vec2 normal = face.normal(query.edge);
  const Vec2 tangent{-normal.y, normal.x};
  const Vec2 start = face.vertex(query.edge);
  const Vec2 end = face.vertex((query.edge + 1) % face.count);
  double low = kInfinity;
  double high = -kInfinity;
  for (std::size_t j = 0; j < other.count; ++j) {
    const Vec2 from_start = other.vertex(j) - start;
    if (dot(normal, from_start) > query.distance + kParallel_m) continue;
    const double along = dot(tangent, from_start);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const double length = dot(tangent, end - start);
  // The contact of overlapping shapes is always on the edge; rounding could say otherwise.
  if (query.distance <= 0) {
    return {std::clamp(low, 0.0, length), std::clamp(high, 0.0, length)};
  }
  return {std::max(low, 0.0), std::min(high, length)};
}

Separation nearest_vertices(const PlacedPolygon& a, const PlacedPolygon& b,
                            Vec2 fallback_normal) noexcept {
  double best = kInfinity;
  Vec2 on_a;
  Vec2 on_b;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      const double squared = squared_norm(b.vertex(j) - a.vertex(i));
      if (squared < best) {
        best = squared;
        on_a = a.vertex(i);
        on_b = b.vertex(j);
      }
    }
  }
  const double distance = std::sqrt(best);
  // Coincident vertices define no direction.
  const Vec2 normal = distance > 1.0e-12 ? (1.0 / distance) * (on_b - on_a) : fallback_normal;
  return {distance, normal, on_a, on_b};
}

}  // namespace

void PlacedPolygon::place(const ConvexPolygon& polygon, SinCos angle, Vec2 position) noexcept {
  count = polygon.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 v = position + rotate(angle, polygon.vertices()[i]);
    const Vec2 n = rotate(angle, polygon.normals()[i]);
    x[i] = v.x;
    y[i] = v.y;
    normal_x[i] = n.x;
    normal_y[i] = n.y;
  }
}

Separation separate(const PlacedPolygon& a, const PlacedPolygon& b) noexcept {
  const FaceQuery of_a = best_face(a, b);
  const FaceQuery of_b = best_face(b, a);
  const bool on_a = of_a.distance >= of_b.distance;
  const PlacedPolygon& face = on_a ? a : b;
  const FaceQuery& query = on_a ? of_a : of_b;
  const Vec2 normal = face.normal(query.edge);
  const Vec2 normal_ab = on_a ? normal : -normal;
  // If a nearest point lies inside an edge, that edge's normal is the best axis; otherwise both
  // nearest points are vertices.
  const Overlap part = facing_part(face, query, on_a ? b : a);
  if (part.low > part.high) return nearest_vertices(a, b, normal_ab);
  const double middle = 0.5 * (part.low + part.high);
  const Vec2 on_face = face.vertex(query.edge) + middle * Vec2{-normal.y, normal.x};
  const Vec2 opposite = on_face + query.distance * normal;
  return {query.distance, normal_ab, on_a ? on_face : opposite, on_a ? opposite : on_face};
}

}  // namespace detail

Separation distance(const ConvexPolygon& a, const Pose2& X_WA, const ConvexPolygon& b,
                    const Pose2& X_WB) noexcept {
  // Computed relative to the origin of B, to keep precision far from the origin of W.
  detail::PlacedPolygon placed_a;
  detail::PlacedPolygon placed_b;
  placed_a.place(a, sincos(X_WA.yaw), X_WA.position() - X_WB.position());
  placed_b.place(b, sincos(X_WB.yaw), {});
  Separation result = detail::separate(placed_a, placed_b);
  result.p_WA = result.p_WA + X_WB.position();
  result.p_WB = result.p_WB + X_WB.position();
  return result;
}

Separation distance(const ConvexPolygon& a, const Pose2& X_WA, Vec2 p_WC,
                    double radius_m) noexcept {
  const SinCos angle = sincos(X_WA.yaw);
  const Vec2 p_AC = rotate_back(angle, p_WC - X_WA.position());
  const auto vertices = a.vertices();
  double depth = -std::numeric_limits<double>::infinity();
  std::size_t edge = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = dot(a.normals()[i], p_AC - vertices[i]);
    if (d > depth) {
      depth = d;
      edge = i;
    }
  }
  Vec2 normal_A = a.normals()[edge];
  Vec2 nearest_A = p_AC - depth * normal_A;
  double center_distance = depth;
  if (depth > 0) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Vec2 along = vertices[(i + 1) % a.size()] - vertices[i];
      const double share =
          std::clamp(dot(p_AC - vertices[i], along) / squared_norm(along), 0.0, 1.0);
      const Vec2 candidate = vertices[i] + share * along;
      const double squared = squared_norm(p_AC - candidate);
      if (squared < best) {
        best = squared;
        nearest_A = candidate;
      }
    }
    center_distance = std::sqrt(best);
    if (center_distance > 1.0e-12) normal_A = (1.0 / center_distance) * (p_AC - nearest_A);
  }
  const double separation = center_distance - radius_m;
  const Vec2 normal_W = rotate(angle, normal_A);
  const Vec2 p_WA = X_WA.position() + rotate(angle, nearest_A);
  return {separation, normal_W, p_WA, p_WA + separation * normal_W};
}

}  // namespace rave
