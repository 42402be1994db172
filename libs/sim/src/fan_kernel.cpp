// SPDX-License-Identifier: Apache-2.0
// Rays of one sensor against the shapes near it, compiled once per instruction set. No operation is
// fused or approximated, so all sets give the same bits.
#include "fan_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

// Compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/fan_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "seen_batches.hpp"

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
// What is seen among many rays covers a few of them: of wider groups most would be tried in vain.
using Rays = hn::CappedTag<float, 8>;

/// The number of shapes that are processed together.
constexpr std::size_t kBatch = 8;

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
      // The operations of bearing_scale() in the same order. A bucket that differed by rounding
      // from that of index_of() could leave out a ray at the edge of a shape.
      const auto sum = hn::Add(hn::Abs(px), hn::Abs(py));
      const auto part = hn::IfThenElse(hn::Gt(sum, zero), hn::Div(px, sum), one);
      const auto scale =
          hn::IfThenElse(hn::Lt(py, zero), hn::Add(one, part), hn::Sub(hn::Set(d, 3.0F), part));
      const auto bucket = hn::ConvertTo(ints, hn::Mul(scale, per_unit));
      hn::StoreU(hn::Max(hn::Min(bucket, last), hn::Zero(ints)), ints, number + i);
    }
  }
};

/// Between which bearings discs are seen.
struct DiscEdges {
  Buckets right;
  Buckets left;

  HWY_INLINE void find(const SeenDiscs<kBatch>& discs) {
    const Eight d;
    const EightFloats floats;
    HWY_ALIGN float right_x[kBatch];
    HWY_ALIGN float right_y[kBatch];
    HWY_ALIGN float left_x[kBatch];
    HWY_ALIGN float left_y[kBatch];
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto r = hn::LoadU(floats, discs.radius + i);
      const auto out = hn::LoadU(d, discs.outside + i);
      // Tangents of a disc at c: c turned by the angle whose sine is r/d and whose cosine is t/d,
      // with t = sqrt(d^2 - r^2). Only the direction counts, so nothing is divided by d.
      const auto tangent = hn::DemoteTo(floats, hn::Sqrt(hn::Max(out, hn::Zero(d))));
      const auto cx = hn::LoadU(floats, discs.centre.x + i);
      const auto cy = hn::LoadU(floats, discs.centre.y + i);
      hn::StoreU(hn::Add(hn::Mul(cx, tangent), hn::Mul(cy, r)), floats, right_x + i);
      hn::StoreU(hn::Sub(hn::Mul(cy, tangent), hn::Mul(cx, r)), floats, right_y + i);
      hn::StoreU(hn::Sub(hn::Mul(cx, tangent), hn::Mul(cy, r)), floats, left_x + i);
      hn::StoreU(hn::Add(hn::Mul(cy, tangent), hn::Mul(cx, r)), floats, left_y + i);
    }
    right.find(right_x, right_y);
    left.find(left_x, left_y);
  }
};

/// Between which bearings polygons are seen.
struct PolygonEdges {
  Buckets right;
  Buckets left;
  HWY_ALIGN float right_x[kBatch] = {};
  HWY_ALIGN float right_y[kBatch] = {};
  HWY_ALIGN float left_x[kBatch] = {};
  HWY_ALIGN float left_y[kBatch] = {};

  HWY_INLINE void put(std::size_t at, const SeenPolygon& polygon) {
    right_x[at] = polygon.right.x;
    right_y[at] = polygon.right.y;
    left_x[at] = polygon.left.x;
    left_y[at] = polygon.left.y;
  }
  HWY_INLINE void find() {
    right.find(right_x, right_y);
    left.find(left_x, left_y);
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
      keep(d, seen.inverse(hn::LoadU(d, fan.cos + ray), hn::LoadU(d, fan.sin + ray)), body,
           fan.inverse + ray, fan.body + ray);
    }
  };
  if (fan.first_ray == nullptr) {
    cast(std::size_t{0}, fan.padded);
    return;
  }
  // The edges give buckets, not rays, so some rays beside the shape are tried in vain. Whether a
  // ray meets it is decided by `seen`, never by the index.
  const std::size_t group = ~(hn::Lanes(d) - 1);
  const std::size_t first = fan.first_ray[right];
  const std::size_t last = fan.first_ray[left + 1];
  if (right <= left) {
    if (first < last) cast(first & group, last);
    return;
  }
  // The shape lies across the bearing of +-pi: its rays are at both ends of the table.
  if (last > 0) cast(std::size_t{0}, last);
  if (first < fan.first_ray[kBearingBuckets]) cast(first & group, fan.padded);
}

HWY_INLINE void keep_all_inside(const FanView& fan, std::uint32_t body) {
  const Rays d;
  const auto inside = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t ray = 0; ray < fan.padded; ray += hn::Lanes(d)) {
    keep(d, inside, body, fan.inverse + ray, fan.body + ray);
  }
}

HWY_INLINE void cast_discs(Pieces discs, const FanPlace& place, const FanView& fan) {
  SeenDiscs<kBatch> seen;
  DiscEdges edges;
  for (std::size_t begin = 0; begin < discs.size(); begin += kBatch) {
    const Pieces batch = discs.subspan(begin, std::min(kBatch, discs.size() - begin));
    seen.see(batch, [&](std::size_t) -> const FanPlace& { return place; });
    edges.find(seen);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (seen.outside[i] <= 0) {
        keep_all_inside(fan, batch[i]->body);
      } else {
        cast_between(fan, edges.right.number[i], edges.left.number[i], seen[i], batch[i]->body);
      }
    }
  }
}

HWY_INLINE void cast_polygons(Pieces polygons, const Vec2* vertices_W, const Vec2* normals_W,
                              const FanPlace& place, const FanView& fan) {
  SeenPolygon seen[kBatch];
  Sight sight[kBatch];
  PolygonEdges edges;
  for (std::size_t begin = 0; begin < polygons.size(); begin += kBatch) {
    const Pieces batch = polygons.subspan(begin, std::min(kBatch, polygons.size() - begin));
    for (std::size_t i = 0; i < batch.size(); ++i) {
      sight[i] = seen[i].see(*batch[i], vertices_W, normals_W, place);
      if (sight[i] == Sight::kOutside) edges.put(i, seen[i]);
    }
    // The edges of the whole batch at once; those of pieces that are not seen from outside are not
    // used.
    edges.find();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (sight[i] == Sight::kInside) keep_all_inside(fan, batch[i]->body);
      if (sight[i] != Sight::kOutside) continue;
      cast_between(fan, edges.right.number[i], edges.left.number[i], seen[i], batch[i]->body);
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
  // Only the rays stay in registers: each shape is loaded once and met by all of them.
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
  // One instance per number of registers: a loop of unknown length would keep the results in
  // memory.
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

void finish_ranges(const FanView& fan, RangeLimits limits, float* ranges_m, std::uint32_t* bodies) {
  const Floats d;
  const Words words;
  const auto one = hn::Set(d, 1.0F);
  const auto nearest = hn::Set(d, limits.min_m);
  const auto farthest = hn::Set(d, limits.max_m);
  const auto none = hn::Set(d, std::numeric_limits<float>::infinity());
  for (std::size_t ray = 0; ray < fan.padded; ray += hn::Lanes(d)) {
    // 1/0 is +infinity and so beyond every limit: no return. Inside a body 1/infinity is 0, which
    // becomes the least range.
    const auto range = hn::Div(one, hn::LoadU(d, fan.inverse + ray));
    const auto beyond = hn::Gt(range, farthest);
    hn::StoreU(hn::IfThenElse(beyond, none, hn::Max(range, nearest)), d, ranges_m + ray);
    const auto body = hn::LoadU(words, fan.body + ray);
    hn::StoreU(hn::IfThenElse(hn::RebindMask(words, beyond), hn::Set(words, 0xffffffffU), body),
               words, bodies + ray);
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

void finish_ranges(const FanView& fan, RangeLimits limits, float* ranges_m, std::uint32_t* bodies) {
  HWY_DYNAMIC_DISPATCH(finish_ranges)(fan, limits, ranges_m, bodies);
}

}  // namespace rave::sim
#endif
