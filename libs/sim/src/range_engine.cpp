// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/range_engine.hpp"

#include <cmath>
#include <limits>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {
namespace {

constexpr double kInside = std::numeric_limits<double>::infinity();

/// Keeps the nearest hit of each ray, as the largest inverse range.
void keep(FanScratch& scratch, std::size_t ray, double inverse, std::uint32_t body) noexcept {
  if (inverse > scratch.inverse[ray]) {
    scratch.inverse[ray] = inverse;
    scratch.body[ray] = body;
  }
}

void keep_all_inside(FanScratch& scratch, std::uint32_t body) noexcept {
  for (std::size_t ray = 0; ray < scratch.inverse.size(); ++ray) {
    keep(scratch, ray, kInside, body);
  }
}

void cast_disc_shape(const FanTable& fan, Vec2 centre_S, double radius_m, std::uint32_t body,
                     FanScratch& scratch) noexcept {
  const double radius2 = radius_m * radius_m;
  if (squared_norm(centre_S) <= radius2) {
    keep_all_inside(scratch, body);
    return;
  }
  for (std::size_t ray = 0; ray < fan.cos.size(); ++ray) {
    const Vec2 direction{fan.cos[ray], fan.sin[ray]};
    const double along = dot(centre_S, direction);
    const double aside = cross(centre_S, direction);
    const double root = radius2 - aside * aside;
    if (along > 0 && root >= 0) keep(scratch, ray, 1.0 / (along - std::sqrt(root)), body);
  }
}

/// An edge that faces the sensor: 1/range = (nx cos + ny sin), already divided by its distance.
struct FacingEdge {
  double nx = 0;
  double ny = 0;
};

void cast_polygon_shape(const FanTable& fan, std::span<const Vec2> vertices_S, std::uint32_t body,
                        FanScratch& scratch) noexcept {
  FacingEdge edges[ConvexPolygon::kMaxVertices];
  std::size_t edge_count = 0;
  // Facing edges of a convex polygon follow one another; the first vertex of the first and the
  // last of the last are the silhouette.
  Vec2 right;
  Vec2 left;
  const std::size_t n = vertices_S.size();
  bool before = false;
  for (std::size_t i = 0; i <= n; ++i) {
    const Vec2 a = vertices_S[i % n];
    const Vec2 b = vertices_S[(i + 1) % n];
    const double c = a.x * b.y - a.y * b.x;  // outward normal . a, the normal being (dy, -dx)
    const bool facing = c < 0;
    if (facing && i < n) edges[edge_count++] = {(b.y - a.y) / c, -(b.x - a.x) / c};
    // Counter-clockwise around the polygon is clockwise as seen from outside: left comes first.
    if (facing && !before && i > 0) left = a;
    if (!facing && before) right = a;
    before = facing;
  }
  if (edge_count == 0) {
    keep_all_inside(scratch, body);
    return;
  }
  for (std::size_t ray = 0; ray < fan.cos.size(); ++ray) {
    const Vec2 direction{fan.cos[ray], fan.sin[ray]};
    if (cross(right, direction) < 0 || cross(direction, left) < 0) continue;
    double inverse = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < edge_count; ++e) {
      const double w = edges[e].nx * direction.x + edges[e].ny * direction.y;
      inverse = w < inverse ? w : inverse;
    }
    keep(scratch, ray, inverse, body);
  }
}

}  // namespace

FanTable FanTable::make(const FanQuery& query, LayerMask layers) {
  FanTable fan;
  fan.rays_per_reading = query.rays_per_reading;
  fan.range_min_m = query.range_min_m;
  fan.range_max_m = query.range_max_m;
  fan.layers = layers;
  for (std::uint32_t i = 0; i < query.ray_count; ++i) {
    const SinCos bearing = sincos(query.bearings_rad[i]);
    fan.cos.push_back(bearing.cos);
    fan.sin.push_back(bearing.sin);
  }
  return fan;
}

void cast_fan(const world::Snapshot& world, const FanTable& fan, const Pose2& X_WS, double z_m,
              BodyId owner, FanScratch& scratch, std::span<float> ranges,
              std::span<std::uint32_t> bodies) {
  scratch.inverse.assign(fan.cos.size(), 0.0);
  scratch.body.assign(fan.cos.size(), BodyId::kNone);
  world.gather(X_WS.position(), fan.range_max_m, scratch.found);
  const SinCos turn = sincos(X_WS.yaw);
  for (const std::uint32_t index : scratch.found) {
    const world::PlacedShape& shape = world.shape(index);
    if (shape.body == owner.value() || !contains(fan.layers, shape.layer) ||
        !shape.at_height(z_m)) {
      continue;
    }
    if (shape.kind == world::ShapeKind::kDisc) {
      cast_disc_shape(fan, rotate_back(turn, shape.centre_W - X_WS.position()), shape.radius_m,
                      shape.body, scratch);
      continue;
    }
    scratch.vertices_S.clear();
    for (const Vec2 v : world.vertices_W(shape)) {
      scratch.vertices_S.push_back(rotate_back(turn, v - X_WS.position()));
    }
    cast_polygon_shape(fan, scratch.vertices_S, shape.body, scratch);
  }
  for (std::size_t reading = 0; reading < ranges.size(); ++reading) {
    double inverse = 0;
    std::uint32_t body = BodyId::kNone;
    for (std::size_t k = 0; k < fan.rays_per_reading; ++k) {
      const std::size_t ray = reading * fan.rays_per_reading + k;
      if (scratch.inverse[ray] > inverse) {
        inverse = scratch.inverse[ray];
        body = scratch.body[ray];
      }
    }
    const double range = 1.0 / inverse;  // 0 gives +infinity, +infinity gives 0
    if (range > fan.range_max_m) {
      ranges[reading] = std::numeric_limits<float>::infinity();
      bodies[reading] = BodyId::kNone;
    } else {
      ranges[reading] = static_cast<float>(range < fan.range_min_m ? fan.range_min_m : range);
      bodies[reading] = body;
    }
  }
}

}  // namespace rave::sim
