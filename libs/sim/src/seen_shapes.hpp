// SPDX-License-Identifier: Apache-2.0
// What a sensor makes out of a shape, for kernels that are compiled once for each set of
// instructions. Included again for each of them, so there is no `#pragma once`.
#if defined(RAVE_SIM_SEEN_SHAPES) == defined(HWY_TARGET_TOGGLE)
#ifdef RAVE_SIM_SEEN_SHAPES
#undef RAVE_SIM_SEEN_SHAPES
#else
#define RAVE_SIM_SEEN_SHAPES
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "fan_kernel.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/world/world_view.hpp"

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, kRayPadding>;
using Words = hn::RebindToUnsigned<Floats>;
// The edges of a polygon are tested in groups of this size.
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
HWY_INLINE Point to_sensor(const FanPlace& place, Vec2 p_W) {
  const auto dx = static_cast<float>(p_W.x - place.x_m);
  const auto dy = static_cast<float>(p_W.y - place.y_m);
  return {place.cos * dx + place.sin * dy, place.cos * dy - place.sin * dx};
}

/// Which of two is nearer: the larger inverse, and whose it is.
template <class V, class W>
HWY_INLINE void keep_nearer(V inverse, std::uint32_t body, V& nearest, W& nearest_body) {
  const hn::DFromV<W> words;
  // Strictly greater: of two equal ones the first stays, so the order of candidates decides.
  const auto nearer = hn::Gt(inverse, nearest);
  nearest = hn::IfThenElse(nearer, inverse, nearest);
  nearest_body = hn::IfThenElse(hn::RebindMask(words, nearer), hn::Set(words, body), nearest_body);
}

/// How a sensor sees a piece.
enum class Sight : std::uint8_t {
  kOutside,  ///< From outside.
  kInside,   ///< It stands inside: all rays read 0.
  kNothing,  ///< Not at all.
};

/// A disc in the sensor frame. A ray meets a disc of radius r about c at
/// 1/range = (a + sqrt(r^2 - b^2)) / (|c|^2 - r^2) with a = c.d ahead and b = c x d aside.
struct SeenDisc {
  Point centre;
  float radius;
  double outside;  ///< |c|^2 - r^2
  float scale;     ///< Its inverse.

  HWY_INLINE Sight see(const world::ShapePiece& piece, const FanPlace& place) {
    const double dx = piece.centre_W.x - place.x_m;
    const double dy = piece.centre_W.y - place.y_m;
    const double r = static_cast<double>(piece.radius_m);
    outside = dx * dx + dy * dy - r * r;
    if (outside <= 0) return Sight::kInside;
    centre = to_sensor(place, piece.centre_W);
    radius = piece.radius_m;
    scale = static_cast<float>(1.0 / outside);
    return Sight::kOutside;
  }
  template <class V>
  HWY_INLINE V inverse(V cos, V sin) const {
    const hn::DFromV<V> d;
    const auto cx = hn::Set(d, centre.x);
    const auto cy = hn::Set(d, centre.y);
    const auto zero = hn::Zero(d);
    const auto ahead = hn::Add(hn::Mul(cx, cos), hn::Mul(cy, sin));
    const auto aside = hn::Sub(hn::Mul(cx, sin), hn::Mul(cy, cos));
    const auto root = hn::Sub(hn::Set(d, radius * radius), hn::Mul(aside, aside));
    // root < 0: the ray passes beside the disc. ahead <= 0: the disc lies behind the sensor.
    const auto met = hn::And(hn::Gt(ahead, zero), hn::Ge(root, zero));
    const auto half = hn::Sqrt(hn::Max(root, zero));
    return hn::IfThenElseZero(met, hn::Mul(hn::Add(ahead, half), hn::Set(d, scale)));
  }
};

/// The edges of a convex polygon that face the sensor, and between which of its vertices it is
/// seen. A line n.p = c is met at 1/range = n.d / c; a convex polygon at the least of those of the
/// edges that face the sensor, by the rays between its two outermost vertices.
struct SeenPolygon {
  float
      x[ConvexPolygon::kMaxVertices + 2];  ///< n/c of each: its line is met at 1/range = (x, y).d.
  float y[ConvexPolygon::kMaxVertices + 2];
  std::size_t count;  ///< At least 3; where fewer face the sensor, one is there more than once.
  Point right;        ///< The outermost vertices.
  Point left;

  HWY_INLINE Sight see(const world::ShapePiece& piece, const Vec2* vertices_W,
                       const Vec2* normals_W, const FanPlace& place);
  HWY_INLINE bool keep_facing(std::uint64_t facing, std::size_t n, const float* edge_x,
                              const float* edge_y, std::size_t& leftmost, std::size_t& rightmost);
  template <class V>
  HWY_INLINE V inverse(V cos, V sin) const {
    const hn::DFromV<V> d;
    const auto zero = hn::Zero(d);
    const auto from_right =
        hn::Sub(hn::Mul(hn::Set(d, right.x), sin), hn::Mul(hn::Set(d, right.y), cos));
    const auto to_left =
        hn::Sub(hn::Mul(cos, hn::Set(d, left.y)), hn::Mul(sin, hn::Set(d, left.x)));
    const auto met = hn::And(hn::Ge(from_right, zero), hn::Ge(to_left, zero));
    const auto along = [&](std::size_t e) HWY_ATTR {
      return hn::Add(hn::Mul(hn::Set(d, x[e]), cos), hn::Mul(hn::Set(d, y[e]), sin));
    };
    // The polygon is the intersection of half planes, so a ray enters it where it has crossed the
    // last of the lines of facing edges: at the largest range, which is the least inverse.
    auto nearest = hn::Min(hn::Min(along(0), along(1)), along(2));
    for (std::size_t e = 3; e < count; ++e) nearest = hn::Min(nearest, along(e));
    return hn::IfThenElseZero(met, nearest);
  }
};

/// Of a polygon of four edges, of which a row of one to three faces the sensor: which, and where
/// the row begins and ends.
struct FacingRow {
  std::uint8_t edges[3];  ///< 0xff in the first: no such row.
  std::uint8_t leftmost;
  std::uint8_t rightmost;
};
/// By the word of facing edges, edge 0 in bit 0. Words 0 and 15 are no row at all, 5 and 10 are not
/// one row; these go the general way.
inline constexpr FacingRow kRowsOfFour[16] = {
    {{0xff, 0, 0}, 0, 0}, {{0, 0, 0}, 0, 1},    {{1, 1, 1}, 1, 2},    {{0, 1, 1}, 0, 2},
    {{2, 2, 2}, 2, 3},    {{0xff, 0, 0}, 0, 0}, {{1, 2, 2}, 1, 3},    {{0, 1, 2}, 0, 3},
    {{3, 3, 3}, 3, 0},    {{3, 0, 0}, 3, 1},    {{0xff, 0, 0}, 0, 0}, {{3, 0, 1}, 3, 2},
    {{2, 3, 3}, 2, 0},    {{2, 3, 0}, 2, 1},    {{1, 2, 3}, 1, 0},    {{0xff, 0, 0}, 0, 0}};

/// Keeps the edges that face the sensor, at least three, and finds the two vertices that their row
/// ends at. False: rounding alone makes no row of them.
HWY_INLINE bool SeenPolygon::keep_facing(std::uint64_t facing, std::size_t n, const float* edge_x,
                                         const float* edge_y, std::size_t& leftmost,
                                         std::size_t& rightmost) {
  if (n == 4 && kRowsOfFour[facing].edges[0] != 0xff) {
    // Without branches: which edges face the sensor is anybody's guess.
    const FacingRow& row = kRowsOfFour[facing];
    for (std::size_t e = 0; e < 3; ++e) {
      x[e] = edge_x[row.edges[e]];
      y[e] = edge_y[row.edges[e]];
    }
    count = 3;
    leftmost = row.leftmost;
    rightmost = row.rightmost;
    return true;
  }
  // The edges that face the sensor are one row; it begins at the left vertex and ends at the right.
  const std::uint64_t all = ~std::uint64_t{0} >> (64U - n);
  const std::uint64_t before = (facing << 1U) | (facing >> (n - 1U));
  const std::uint64_t begin = facing & ~before;
  const std::uint64_t end = ~facing & before & all;
  if (begin == 0 || end == 0) return false;  // rounding alone can make every edge face it
  count = 0;
  for (std::size_t e = 0; e < n; ++e) {
    x[count] = edge_x[e];
    y[count] = edge_y[e];
    count += (facing >> e) & 1U;
  }
  for (; count < 3; ++count) {
    x[count] = x[0];
    y[count] = y[0];
  }
  leftmost = hwy::Num0BitsBelowLS1Bit_Nonzero64(begin);
  rightmost = hwy::Num0BitsBelowLS1Bit_Nonzero64(end);
  return true;
}

HWY_INLINE Sight SeenPolygon::see(const world::ShapePiece& piece, const Vec2* vertices_W,
                                  const Vec2* normals_W, const FanPlace& place) {
  const Quads d;
  const QuadFloats floats;
  const auto sensor_x = hn::Set(d, place.x_m);
  const auto sensor_y = hn::Set(d, place.y_m);
  const auto cos = hn::Set(floats, place.cos);
  const auto sin = hn::Set(floats, place.sin);
  const std::size_t n = piece.vertex_count;
  const Vec2* const vertices = vertices_W + piece.first_vertex;
  const Vec2* const normals = normals_W + piece.first_vertex;
  HWY_ALIGN float edge_x[ConvexPolygon::kMaxVertices + 4];
  HWY_ALIGN float edge_y[ConvexPolygon::kMaxVertices + 4];
  HWY_ALIGN float vertex_x[ConvexPolygon::kMaxVertices + 4];
  HWY_ALIGN float vertex_y[ConvexPolygon::kMaxVertices + 4];
  std::uint64_t facing = 0;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    auto vx = hn::Zero(d);
    auto vy = hn::Zero(d);
    auto nx = hn::Zero(d);
    auto ny = hn::Zero(d);
    // Reads beyond the last vertex of this polygon are allowed (kVertexPadding); `all` drops their
    // bits.
    hn::LoadInterleaved2(d, &vertices[i].x, vx, vy);
    hn::LoadInterleaved2(d, &normals[i].x, nx, ny);
    const auto dx = hn::Sub(vx, sensor_x);
    const auto dy = hn::Sub(vy, sensor_y);
    // c = n.(v - p), with n outward: negative where the sensor is on the outer side of the edge. In
    // double, because this sign decides what is seen.
    const auto c = hn::Add(hn::Mul(nx, dx), hn::Mul(ny, dy));
    facing |= std::uint64_t{bits_of(d, hn::Lt(c, hn::Zero(d)))} << i;
    const auto scale = hn::DemoteTo(floats, hn::Div(hn::Set(d, 1.0), c));
    const auto ux = hn::DemoteTo(floats, nx);
    const auto uy = hn::DemoteTo(floats, ny);
    hn::StoreU(hn::Mul(hn::Add(hn::Mul(cos, ux), hn::Mul(sin, uy)), scale), floats, edge_x + i);
    hn::StoreU(hn::Mul(hn::Sub(hn::Mul(cos, uy), hn::Mul(sin, ux)), scale), floats, edge_y + i);
    const auto px = hn::DemoteTo(floats, dx);
    const auto py = hn::DemoteTo(floats, dy);
    hn::StoreU(hn::Add(hn::Mul(cos, px), hn::Mul(sin, py)), floats, vertex_x + i);
    hn::StoreU(hn::Sub(hn::Mul(cos, py), hn::Mul(sin, px)), floats, vertex_y + i);
  }
  const std::uint64_t all = ~std::uint64_t{0} >> (64U - n);
  facing &= all;
  if (facing == 0) return Sight::kInside;
  std::size_t leftmost = 0;
  std::size_t rightmost = 0;
  if (!keep_facing(facing, n, edge_x, edge_y, leftmost, rightmost)) return Sight::kNothing;
  right = {vertex_x[rightmost], vertex_y[rightmost]};
  left = {vertex_x[leftmost], vertex_y[leftmost]};
  return Sight::kOutside;
}

}  // namespace rave::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
