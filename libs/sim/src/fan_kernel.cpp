// SPDX-License-Identifier: Apache-2.0
#include "fan_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/convex_polygon.hpp"
#include "rave/world/world_view.hpp"

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
// What is seen among many rays covers a few of them: of wider groups most would be tried in vain.
using Rays = hn::CappedTag<float, 8>;
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
HWY_INLINE Point to_sensor(const FanPlace& place, Vec2 p_W) {
  const auto dx = static_cast<float>(p_W.x - place.x_m);
  const auto dy = static_cast<float>(p_W.y - place.y_m);
  return {place.cos * dx + place.sin * dy, place.cos * dy - place.sin * dx};
}

/// Which of two is nearer: the larger inverse, and whose it is.
template <class V, class W>
HWY_INLINE void keep_nearer(V inverse, std::uint32_t body, V& nearest, W& nearest_body) {
  const hn::DFromV<W> words;
  const auto nearer = hn::Gt(inverse, nearest);
  nearest = hn::IfThenElse(nearer, inverse, nearest);
  nearest_body = hn::IfThenElse(hn::RebindMask(words, nearer), hn::Set(words, body), nearest_body);
}

/// `d` is given: from a vector of no fixed size one does not learn how much of it is used.
template <class D, class V>
HWY_INLINE void keep(D d, const FanView& fan, std::size_t ray, V inverse, std::uint32_t body) {
  const hn::RebindToUnsigned<D> words;
  auto nearest = hn::LoadU(d, fan.inverse + ray);
  auto nearest_body = hn::LoadU(words, fan.body + ray);
  keep_nearer(inverse, body, nearest, nearest_body);
  hn::StoreU(nearest, d, fan.inverse + ray);
  hn::StoreU(nearest_body, words, fan.body + ray);
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
  std::size_t count;    ///< At least 3; where fewer face the sensor, one is there more than once.
  const Vec2* right_W;  ///< The outermost vertices.
  const Vec2* left_W;
  Point right;  ///< The same, in the sensor frame.
  Point left;

  /// All but `right` and `left`.
  HWY_INLINE Sight see(const world::ShapePiece& piece, const Vec2* vertices_W,
                       const Vec2* normals_W, const FanPlace& place);
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
inline constexpr FacingRow kRowsOfFour[16] = {
    {{0xff, 0, 0}, 0, 0}, {{0, 0, 0}, 0, 1},    {{1, 1, 1}, 1, 2},    {{0, 1, 1}, 0, 2},
    {{2, 2, 2}, 2, 3},    {{0xff, 0, 0}, 0, 0}, {{1, 2, 2}, 1, 3},    {{0, 1, 2}, 0, 3},
    {{3, 3, 3}, 3, 0},    {{3, 0, 0}, 3, 1},    {{0xff, 0, 0}, 0, 0}, {{3, 0, 1}, 3, 2},
    {{2, 3, 3}, 2, 0},    {{2, 3, 0}, 2, 1},    {{1, 2, 3}, 1, 0},    {{0xff, 0, 0}, 0, 0}};

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
  std::uint64_t facing = 0;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    auto vx = hn::Zero(d);
    auto vy = hn::Zero(d);
    auto nx = hn::Zero(d);
    auto ny = hn::Zero(d);
    hn::LoadInterleaved2(d, &vertices[i].x, vx, vy);
    hn::LoadInterleaved2(d, &normals[i].x, nx, ny);
    const auto c = hn::Add(hn::Mul(nx, hn::Sub(vx, sensor_x)), hn::Mul(ny, hn::Sub(vy, sensor_y)));
    facing |= std::uint64_t{bits_of(d, hn::Lt(c, hn::Zero(d)))} << i;
    const auto scale = hn::DemoteTo(floats, hn::Div(hn::Set(d, 1.0), c));
    const auto ux = hn::DemoteTo(floats, nx);
    const auto uy = hn::DemoteTo(floats, ny);
    hn::StoreU(hn::Mul(hn::Add(hn::Mul(cos, ux), hn::Mul(sin, uy)), scale), floats, edge_x + i);
    hn::StoreU(hn::Mul(hn::Sub(hn::Mul(cos, uy), hn::Mul(sin, ux)), scale), floats, edge_y + i);
  }
  const std::uint64_t all = ~std::uint64_t{0} >> (64U - n);
  facing &= all;
  if (facing == 0) return Sight::kInside;
  std::size_t leftmost = 0;
  std::size_t rightmost = 0;
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
  } else {
    // The edges that face the sensor are one row; it begins at the left vertex and ends at the
    // right.
    const std::uint64_t before = (facing << 1U) | (facing >> (n - 1U));
    const std::uint64_t begin = facing & ~before;
    const std::uint64_t end = ~facing & before & all;
    if (begin == 0 || end == 0)
      return Sight::kNothing;  // rounding alone can make every edge face it
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
  }
  right_W = vertices + rightmost;
  left_W = vertices + leftmost;
  return Sight::kOutside;
}

/// So many shapes are made out together.
constexpr std::size_t kBatch = 8;
using Eight = hn::CappedTag<double, kBatch>;
using EightFloats = hn::Rebind<float, Eight>;

/// Points of the world, relative to the sensor, and where they are in its frame. The difference is
/// taken in double, as in to_sensor().
struct Points {
  HWY_ALIGN double dx[kBatch] = {};
  HWY_ALIGN double dy[kBatch] = {};
  HWY_ALIGN float x[kBatch] = {};
  HWY_ALIGN float y[kBatch] = {};

  HWY_INLINE void put(std::size_t at, Vec2 p_W, const FanPlace& place) {
    dx[at] = p_W.x - place.x_m;
    dy[at] = p_W.y - place.y_m;
  }
  [[nodiscard]] HWY_INLINE Point operator[](std::size_t at) const { return {x[at], y[at]}; }
  HWY_INLINE void turn(const FanPlace& place) {
    const Eight d;
    const EightFloats floats;
    const auto cos = hn::Set(floats, place.cos);
    const auto sin = hn::Set(floats, place.sin);
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto ux = hn::DemoteTo(floats, hn::LoadU(d, dx + i));
      const auto uy = hn::DemoteTo(floats, hn::LoadU(d, dy + i));
      hn::StoreU(hn::Add(hn::Mul(cos, ux), hn::Mul(sin, uy)), floats, x + i);
      hn::StoreU(hn::Sub(hn::Mul(cos, uy), hn::Mul(sin, ux)), floats, y + i);
    }
  }
};

/// The buckets of bearings, as bearing_bucket() has them.
struct Buckets {
  HWY_ALIGN std::int32_t number[kBatch];

  HWY_INLINE void find(const float* x, const float* y) {
    const hn::CappedTag<float, kBatch> d;
    const hn::RebindToSigned<hn::CappedTag<float, kBatch>> ints;
    const auto zero = hn::Zero(d);
    const auto one = hn::Set(d, 1.0F);
    const auto per_unit = hn::Set(d, static_cast<float>(kBearingBuckets) / 4.0F);
    const auto last = hn::Set(ints, static_cast<std::int32_t>(kBearingBuckets) - 1);
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto px = hn::LoadU(d, x + i);
      const auto py = hn::LoadU(d, y + i);
      const auto sum = hn::Add(hn::Abs(px), hn::Abs(py));
      const auto part = hn::IfThenElse(hn::Gt(sum, zero), hn::Div(px, sum), one);
      const auto scale =
          hn::IfThenElse(hn::Lt(py, zero), hn::Add(one, part), hn::Sub(hn::Set(d, 3.0F), part));
      const auto bucket = hn::ConvertTo(ints, hn::Mul(scale, per_unit));
      hn::StoreU(hn::Max(hn::Min(bucket, last), hn::Zero(ints)), ints, number + i);
    }
  }
};

/// Up to kBatch discs.
struct SeenDiscs {
  Points centre;
  HWY_ALIGN float radius[kBatch] = {};
  HWY_ALIGN double outside[kBatch] = {};
  HWY_ALIGN float scale[kBatch] = {};
  Buckets right;
  Buckets left;

  HWY_INLINE void see(Pieces pieces, const FanPlace& place) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      centre.put(i, pieces[i]->centre_W, place);
      radius[i] = pieces[i]->radius_m;
    }
    centre.turn(place);
    const Eight d;
    const EightFloats floats;
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto dx = hn::LoadU(d, centre.dx + i);
      const auto dy = hn::LoadU(d, centre.dy + i);
      const auto r = hn::PromoteTo(d, hn::LoadU(floats, radius + i));
      const auto out = hn::Sub(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(r, r));
      hn::StoreU(out, d, outside + i);
      hn::StoreU(hn::DemoteTo(floats, hn::Div(hn::Set(d, 1.0), out)), floats, scale + i);
    }
    find_edges();
  }

  /// Between which bearings they are seen.
  HWY_INLINE void find_edges() {
    const Eight d;
    const EightFloats floats;
    HWY_ALIGN float right_x[kBatch];
    HWY_ALIGN float right_y[kBatch];
    HWY_ALIGN float left_x[kBatch];
    HWY_ALIGN float left_y[kBatch];
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto r = hn::LoadU(floats, radius + i);
      const auto out = hn::LoadU(d, outside + i);
      const auto tangent = hn::DemoteTo(floats, hn::Sqrt(hn::Max(out, hn::Zero(d))));
      const auto cx = hn::LoadU(floats, centre.x + i);
      const auto cy = hn::LoadU(floats, centre.y + i);
      hn::StoreU(hn::Add(hn::Mul(cx, tangent), hn::Mul(cy, r)), floats, right_x + i);
      hn::StoreU(hn::Sub(hn::Mul(cy, tangent), hn::Mul(cx, r)), floats, right_y + i);
      hn::StoreU(hn::Sub(hn::Mul(cx, tangent), hn::Mul(cy, r)), floats, left_x + i);
      hn::StoreU(hn::Add(hn::Mul(cy, tangent), hn::Mul(cx, r)), floats, left_y + i);
    }
    right.find(right_x, right_y);
    left.find(left_x, left_y);
  }
  [[nodiscard]] HWY_INLINE SeenDisc operator[](std::size_t at) const {
    return {centre[at], radius[at], outside[at], scale[at]};
  }
};

/// Puts what the rays between the buckets of two bearings, counter-clockwise from `right` to
/// `left`, meet of a shape into the fan; whole groups, so some rays more.
template <class Seen>
HWY_INLINE void cast_between(const FanView& fan, std::int32_t right, std::int32_t left,
                             const Seen& seen, std::uint32_t body) {
  const Rays d;
  const auto cast = [&](std::size_t first, std::size_t last) HWY_ATTR {
    for (std::size_t ray = first; ray < last; ray += hn::Lanes(d)) {
      keep(d, fan, ray, seen.inverse(hn::LoadU(d, fan.cos + ray), hn::LoadU(d, fan.sin + ray)),
           body);
    }
  };
  if (fan.first_ray == nullptr) {
    cast(std::size_t{0}, fan.padded);
    return;
  }
  const std::size_t group = ~(hn::Lanes(d) - 1);
  const std::size_t first = fan.first_ray[right];
  const std::size_t last = fan.first_ray[left + 1];
  if (right <= left) {
    if (first < last) cast(first & group, last);
    return;
  }
  if (last > 0) cast(std::size_t{0}, last);
  if (first < fan.first_ray[kBearingBuckets]) cast(first & group, fan.padded);
}

HWY_INLINE void keep_all_inside(const FanView& fan, std::uint32_t body) {
  const Rays d;
  const auto inside = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t ray = 0; ray < fan.padded; ray += hn::Lanes(d)) keep(d, fan, ray, inside, body);
}

HWY_INLINE void cast_discs(Pieces discs, const FanPlace& place, const FanView& fan) {
  SeenDiscs seen;
  for (std::size_t begin = 0; begin < discs.size(); begin += kBatch) {
    const Pieces batch = discs.subspan(begin, std::min(kBatch, discs.size() - begin));
    seen.see(batch, place);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (seen.outside[i] <= 0) {
        keep_all_inside(fan, batch[i]->body);
      } else {
        cast_between(fan, seen.right.number[i], seen.left.number[i], seen[i], batch[i]->body);
      }
    }
  }
}

/// Up to kBatch polygons.
struct SeenPolygons {
  SeenPolygon polygon[kBatch];
  Sight sight[kBatch];
  Points right;
  Points left;

  HWY_INLINE void see(Pieces pieces, const Vec2* vertices_W, const Vec2* normals_W,
                      const FanPlace& place) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      sight[i] = polygon[i].see(*pieces[i], vertices_W, normals_W, place);
      if (sight[i] != Sight::kOutside) continue;
      right.put(i, *polygon[i].right_W, place);
      left.put(i, *polygon[i].left_W, place);
    }
    right.turn(place);
    left.turn(place);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      polygon[i].right = right[i];
      polygon[i].left = left[i];
    }
  }
};

HWY_INLINE void cast_polygons(Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                              const FanPlace& place, const FanView& fan) {
  SeenPolygons seen;
  Buckets from;
  Buckets to;
  for (std::size_t begin = 0; begin < polygons.size(); begin += kBatch) {
    const Pieces batch = polygons.subspan(begin, std::min(kBatch, polygons.size() - begin));
    seen.see(batch, vertices_W, normals_W, place);
    from.find(seen.right.x, seen.right.y);
    to.find(seen.left.x, seen.left.y);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (seen.sight[i] == Sight::kInside) keep_all_inside(fan, batch[i]->body);
      if (seen.sight[i] != Sight::kOutside) continue;
      cast_between(fan, from.number[i], to.number[i], seen.polygon[i], batch[i]->body);
    }
  }
}

/// Many rays: of each shape those that could meet it.
void cast_many(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
               const FanPlace& place, const FanView& fan) {
  std::fill_n(fan.inverse, fan.padded, 0.0F);
  std::fill_n(fan.body, fan.padded, BodyId::kNone);
  cast_discs(discs, place, fan);
  cast_polygons(polygons, vertices_W, normals_W, place, fan);
}

#if !HWY_HAVE_SCALABLE
/// Few rays, kGroups registers of them: all are tried against every shape, and what they have met
/// stays in registers. Such sensors mostly see a handful of shapes, too few to make them out
/// together.
template <std::size_t kGroups>
void cast_few(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
              const FanPlace& place, const FanView& fan) {
  const Floats d;
  const Words words;
  using V = decltype(hn::Zero(d));
  using W = decltype(hn::Zero(words));
  V cos[kGroups];
  V sin[kGroups];
  V inverse[kGroups];
  W body[kGroups];
  for (std::size_t g = 0; g < kGroups; ++g) {
    cos[g] = hn::LoadU(d, fan.cos + g * hn::Lanes(d));
    sin[g] = hn::LoadU(d, fan.sin + g * hn::Lanes(d));
    inverse[g] = hn::Zero(d);
    body[g] = hn::Set(words, BodyId::kNone);
  }
  const auto keep_inside = [&](std::uint32_t whose) HWY_ATTR {
    const auto inside = hn::Set(d, std::numeric_limits<float>::infinity());
    for (std::size_t g = 0; g < kGroups; ++g) keep_nearer(inside, whose, inverse[g], body[g]);
  };
  SeenDisc disc;
  for (const world::ShapePiece* const piece : discs) {
    if (disc.see(*piece, place) == Sight::kInside) {
      keep_inside(piece->body);
      continue;
    }
    for (std::size_t g = 0; g < kGroups; ++g) {
      keep_nearer(disc.inverse(cos[g], sin[g]), piece->body, inverse[g], body[g]);
    }
  }
  SeenPolygon polygon;
  for (const world::ShapePiece* const piece : polygons) {
    const Sight sight = polygon.see(*piece, vertices_W, normals_W, place);
    if (sight == Sight::kInside) keep_inside(piece->body);
    if (sight != Sight::kOutside) continue;
    polygon.right = to_sensor(place, *polygon.right_W);
    polygon.left = to_sensor(place, *polygon.left_W);
    for (std::size_t g = 0; g < kGroups; ++g) {
      keep_nearer(polygon.inverse(cos[g], sin[g]), piece->body, inverse[g], body[g]);
    }
  }
  for (std::size_t g = 0; g < kGroups; ++g) {
    hn::StoreU(inverse[g], d, fan.inverse + g * hn::Lanes(d));
    hn::StoreU(body[g], words, fan.body + g * hn::Lanes(d));
  }
}
#endif

void cast_pieces(Pieces discs, Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                 const FanPlace& place, const FanView& fan) {
#if !HWY_HAVE_SCALABLE
  constexpr std::size_t kLanes = hn::MaxLanes(Floats());
  if (fan.first_ray == nullptr && fan.padded == kRayPadding) {
    cast_few<kRayPadding / kLanes>(discs, polygons, vertices_W, normals_W, place, fan);
    return;
  }
  if (fan.first_ray == nullptr && fan.padded == 2 * kRayPadding) {
    cast_few<2 * kRayPadding / kLanes>(discs, polygons, vertices_W, normals_W, place, fan);
    return;
  }
#endif
  cast_many(discs, polygons, vertices_W, normals_W, place, fan);
}

void finish_ranges(const FanView& fan, RangeLimits limits, float* ranges_m) {
  const Floats d;
  const Words words;
  const auto one = hn::Set(d, 1.0F);
  const auto nearest = hn::Set(d, limits.min_m);
  const auto farthest = hn::Set(d, limits.max_m);
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

void finish_ranges(const FanView& fan, RangeLimits limits, float* ranges_m) {
  HWY_DYNAMIC_DISPATCH(finish_ranges)(fan, limits, ranges_m);
}

}  // namespace rave::sim
#endif
