// SPDX-License-Identifier: Apache-2.0
#include "fan_kernel.hpp"

#include <cmath>
#include <limits>

#include "rave/math/convex_polygon.hpp"

// Compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/fan_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, kRayPadding>;
using Words = hn::RebindToUnsigned<Floats>;
// The edges of a polygon are looked at in groups of so many.
using Quads = hn::CappedTag<double, world::kVertexPadding + 1>;
using QuadFloats = hn::Rebind<float, Quads>;

/// A bit for each lane, at most 8.
template <class D, class M>
HWY_INLINE unsigned bits_of(D d, M mask) {
  std::uint8_t bits = 0;
  hn::StoreMaskBits(d, mask, &bits);
  return bits & ((1U << hn::Lanes(d)) - 1U);
}

struct Point {
  float x;  // no default: many of them are made and few are filled
  float y;
};

/// A point of the world in the sensor frame. The difference is taken in double: far from the origin
/// a float could not hold it.
HWY_INLINE Point to_sensor(const FanPlace& place, double x_W, double y_W) {
  const auto dx = static_cast<float>(x_W - place.x_m);
  const auto dy = static_cast<float>(y_W - place.y_m);
  return {place.cos * dx + place.sin * dy, place.cos * dy - place.sin * dx};
}

template <class V>
HWY_INLINE void keep(const FanView& fan, std::size_t ray, V inverse, std::uint32_t body) {
  const Floats d;
  const Words words;
  const auto before = hn::LoadU(d, fan.inverse + ray);
  const auto nearer = hn::Gt(inverse, before);
  hn::StoreU(hn::IfThenElse(nearer, inverse, before), d, fan.inverse + ray);
  const auto body_before = hn::LoadU(words, fan.body + ray);
  hn::StoreU(hn::IfThenElse(hn::RebindMask(words, nearer), hn::Set(words, body), body_before),
             words, fan.body + ray);
}

HWY_INLINE void keep_all_inside(const FanView& fan, std::uint32_t body) {
  const Floats d;
  const auto inside = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t ray = 0; ray < fan.padded; ray += hn::Lanes(d)) keep(fan, ray, inside, body);
}

/// Calls `cast(first, last)` for the rays between two bearings, counter-clockwise from `right` to
/// `left`; whole groups, so some rays more.
template <class Cast>
HWY_INLINE void for_rays_between(const FanView& fan, Point right, Point left, const Cast& cast) {
  if (fan.first_ray == nullptr) {
    cast(std::size_t{0}, fan.padded);
    return;
  }
  const std::size_t from = bearing_bucket(bearing_scale(right.x, right.y));
  const std::size_t to = bearing_bucket(bearing_scale(left.x, left.y));
  const std::size_t group = ~(hn::Lanes(Floats()) - 1);
  const std::size_t first = fan.first_ray[from];
  const std::size_t last = fan.first_ray[to + 1];
  if (from <= to) {
    if (first < last) cast(first & group, last);
    return;
  }
  if (last > 0) cast(std::size_t{0}, last);
  if (first < fan.first_ray[kBearingBuckets]) cast(first & group, fan.padded);
}

/// A ray meets a disc of radius r about c at 1/range = (a + sqrt(r^2 - b^2)) / (|c|^2 - r^2) with
/// a = c.d ahead and b = c x d aside.
HWY_INLINE void cast_disc_piece(const world::ShapePiece& piece, const FanPlace& place,
                                const FanView& fan) {
  const double dx = piece.centre_W.x - place.x_m;
  const double dy = piece.centre_W.y - place.y_m;
  const double radius = static_cast<double>(piece.radius_m);
  const double outside = dx * dx + dy * dy - radius * radius;
  if (outside <= 0) {
    keep_all_inside(fan, piece.body);
    return;
  }
  const Point centre = to_sensor(place, piece.centre_W.x, piece.centre_W.y);
  const float r = piece.radius_m;
  Point right{0, 0};
  Point left{0, 0};
  if (fan.first_ray != nullptr) {
    const float tangent = static_cast<float>(std::sqrt(outside));
    right = {centre.x * tangent + centre.y * r, centre.y * tangent - centre.x * r};
    left = {centre.x * tangent - centre.y * r, centre.y * tangent + centre.x * r};
  }
  const Floats d;
  const auto cx = hn::Set(d, centre.x);
  const auto cy = hn::Set(d, centre.y);
  const auto radius2 = hn::Set(d, r * r);
  const auto scale = hn::Set(d, static_cast<float>(1.0 / outside));
  const auto zero = hn::Zero(d);
  for_rays_between(fan, right, left, [&](std::size_t first, std::size_t last) HWY_ATTR {
    for (std::size_t ray = first; ray < last; ray += hn::Lanes(d)) {
      const auto cos = hn::LoadU(d, fan.cos + ray);
      const auto sin = hn::LoadU(d, fan.sin + ray);
      const auto ahead = hn::Add(hn::Mul(cx, cos), hn::Mul(cy, sin));
      const auto aside = hn::Sub(hn::Mul(cx, sin), hn::Mul(cy, cos));
      const auto root = hn::Sub(radius2, hn::Mul(aside, aside));
      const auto met = hn::And(hn::Gt(ahead, zero), hn::Ge(root, zero));
      const auto half = hn::Sqrt(hn::Max(root, zero));
      keep(fan, ray, hn::IfThenElseZero(met, hn::Mul(hn::Add(ahead, half), scale)), piece.body);
    }
  });
}

/// The edges of a convex polygon that face the sensor.
struct FacingEdges {
  float
      x[ConvexPolygon::kMaxVertices + 1];  ///< n/c of each: its line is met at 1/range = (x, y).d.
  float y[ConvexPolygon::kMaxVertices + 1];
  std::size_t count = 0;     ///< If it is 1, that edge is there twice.
  std::uint64_t facing = 0;  ///< A bit for each edge of the polygon.
};

HWY_INLINE FacingEdges facing_edges(const world::ShapePiece& piece, const Vec2* vertices_W,
                                    const Vec2* normals_W, const FanPlace& place) {
  const Quads d;
  const QuadFloats floats;
  const auto sensor_x = hn::Set(d, place.x_m);
  const auto sensor_y = hn::Set(d, place.y_m);
  const auto cos = hn::Set(floats, place.cos);
  const auto sin = hn::Set(floats, place.sin);
  const std::size_t n = piece.vertex_count;
  FacingEdges edges;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    auto vx = hn::Undefined(d);
    auto vy = hn::Undefined(d);
    auto nx = hn::Undefined(d);
    auto ny = hn::Undefined(d);
    hn::LoadInterleaved2(d, &vertices_W[piece.first_vertex + i].x, vx, vy);
    hn::LoadInterleaved2(d, &normals_W[piece.first_vertex + i].x, nx, ny);
    const auto c = hn::Add(hn::Mul(nx, hn::Sub(vx, sensor_x)), hn::Mul(ny, hn::Sub(vy, sensor_y)));
    unsigned facing = bits_of(d, hn::Lt(c, hn::Zero(d)));
    if (n - i < hn::Lanes(d)) facing &= (1U << (n - i)) - 1U;
    const auto scale = hn::DemoteTo(floats, hn::Div(hn::Set(d, 1.0), c));
    const auto x = hn::DemoteTo(floats, nx);
    const auto y = hn::DemoteTo(floats, ny);
    HWY_ALIGN float edge_x[4];
    HWY_ALIGN float edge_y[4];
    hn::Store(hn::Mul(hn::Add(hn::Mul(cos, x), hn::Mul(sin, y)), scale), floats, edge_x);
    hn::Store(hn::Mul(hn::Sub(hn::Mul(cos, y), hn::Mul(sin, x)), scale), floats, edge_y);
    // Without branches: which edges face the sensor is anybody's guess.
    for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
      edges.x[edges.count] = edge_x[lane];
      edges.y[edges.count] = edge_y[lane];
      edges.count += (facing >> lane) & 1U;
    }
    edges.facing |= std::uint64_t{facing} << i;
  }
  if (edges.count == 1) {
    edges.x[1] = edges.x[0];
    edges.y[1] = edges.y[0];
  }
  return edges;
}

/// A line n.p = c is met at 1/range = n.d / c; a convex polygon at the least of those of the edges
/// that face the sensor, by the rays between its two outermost vertices.
HWY_INLINE void cast_polygon_piece(const world::ShapePiece& piece, const Vec2* vertices_W,
                                   const Vec2* normals_W, const FanPlace& place,
                                   const FanView& fan) {
  const FacingEdges edges = facing_edges(piece, vertices_W, normals_W, place);
  const std::uint64_t all = ~std::uint64_t{0} >> (64U - piece.vertex_count);
  if (edges.facing == 0) {
    keep_all_inside(fan, piece.body);
    return;
  }
  // The edges that face the sensor are one row; it begins at the left vertex and ends at the right.
  const std::uint64_t before = ((edges.facing << 1U) | (edges.facing >> (piece.vertex_count - 1U)));
  const std::uint64_t begin = edges.facing & ~before;
  const std::uint64_t end = ~edges.facing & before & all;
  if (begin == 0 || end == 0) return;  // rounding alone can make every edge face it
  const Vec2* const vertices = vertices_W + piece.first_vertex;
  const std::size_t leftmost = hwy::Num0BitsBelowLS1Bit_Nonzero64(begin);
  const std::size_t rightmost = hwy::Num0BitsBelowLS1Bit_Nonzero64(end);
  const Point left = to_sensor(place, vertices[leftmost].x, vertices[leftmost].y);
  const Point right = to_sensor(place, vertices[rightmost].x, vertices[rightmost].y);
  const Floats d;
  const auto right_x = hn::Set(d, right.x);
  const auto right_y = hn::Set(d, right.y);
  const auto left_x = hn::Set(d, left.x);
  const auto left_y = hn::Set(d, left.y);
  const auto zero = hn::Zero(d);
  for_rays_between(fan, right, left, [&](std::size_t first, std::size_t last) HWY_ATTR {
    for (std::size_t ray = first; ray < last; ray += hn::Lanes(d)) {
      const auto cos = hn::LoadU(d, fan.cos + ray);
      const auto sin = hn::LoadU(d, fan.sin + ray);
      const auto from_right = hn::Sub(hn::Mul(right_x, sin), hn::Mul(right_y, cos));
      const auto to_left = hn::Sub(hn::Mul(cos, left_y), hn::Mul(sin, left_x));
      const auto met = hn::And(hn::Ge(from_right, zero), hn::Ge(to_left, zero));
      const auto along = [&](std::size_t e) HWY_ATTR {
        return hn::Add(hn::Mul(hn::Set(d, edges.x[e]), cos), hn::Mul(hn::Set(d, edges.y[e]), sin));
      };
      auto inverse = hn::Min(along(0), along(1));
      for (std::size_t e = 2; e < edges.count; ++e) inverse = hn::Min(inverse, along(e));
      keep(fan, ray, hn::IfThenElseZero(met, inverse), piece.body);
    }
  });
}

void cast_pieces(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                 const FanPlace& place, const FanView& fan) {
  for (const world::ShapePiece* const piece : discs) cast_disc_piece(*piece, place, fan);
  for (const world::ShapePiece* const piece : polygons) {
    cast_polygon_piece(*piece, vertices_W, normals_W, place, fan);
  }
}

void finish_ranges(const FanView& fan, float range_min_m, float range_max_m, float* ranges_m) {
  const Floats d;
  const Words words;
  const auto one = hn::Set(d, 1.0F);
  const auto nearest = hn::Set(d, range_min_m);
  const auto farthest = hn::Set(d, range_max_m);
  const auto none = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t ray = 0; ray < fan.padded; ray += hn::Lanes(d)) {
    const auto range = hn::Div(one, hn::LoadU(d, fan.inverse + ray));
    const auto beyond = hn::Gt(range, farthest);
    hn::StoreU(hn::IfThenElse(beyond, none, hn::Max(range, nearest)), d, ranges_m + ray);
    const auto body = hn::LoadU(words, fan.body + ray);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(words, beyond), hn::Set(words, 0xffffffffU), body),
               words, fan.body + ray);
  }
}

}  // namespace rave::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rave::sim {

HWY_EXPORT(cast_pieces);
HWY_EXPORT(finish_ranges);

void cast_pieces(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                 const FanPlace& place, const FanView& fan) {
  HWY_DYNAMIC_DISPATCH(cast_pieces)(discs, polygons, vertices_W, normals_W, place, fan);
}

void finish_ranges(const FanView& fan, float range_min_m, float range_max_m, float* ranges_m) {
  HWY_DYNAMIC_DISPATCH(finish_ranges)(fan, range_min_m, range_max_m, ranges_m);
}

}  // namespace rave::sim
#endif
