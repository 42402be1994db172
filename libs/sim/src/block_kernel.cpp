// SPDX-License-Identifier: Apache-2.0
// Rays of many sensors with few rays each, cast together.
#include "block_kernel.hpp"

#include <algorithm>
#include <limits>

// Compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/block_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "seen_batches.hpp"

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A sensor inside a body.
struct AllInside {
  template <class V>
  HWY_INLINE V inverse(V /*cos*/, V /*sin*/) const {
    return hn::Set(hn::DFromV<V>(), std::numeric_limits<float>::infinity());
  }
};

/// Tries all rays of a sensor against what it sees.
template <std::size_t kPadded, class Seen>
HWY_INLINE void cast_all(const BlockView& view, std::size_t asker, const Seen& seen,
                         std::uint32_t body) {
  const Floats d;
  float* const inverse = view.inverse + asker * kPadded;
  std::uint32_t* const bodies = view.body + asker * kPadded;
  for (std::size_t ray = 0; ray < kPadded; ray += hn::Lanes(d)) {
    keep(d, seen.inverse(hn::LoadU(d, view.cos + ray), hn::LoadU(d, view.sin + ray)), body,
         inverse + ray, bodies + ray);
  }
}

/// What several sensors see is made out together: one sees a handful of shapes, too few for that,
/// and where its list ends no processor can foresee.
template <std::size_t kPadded>
void cast_padded(const SeenBy& discs, const SeenBy& polygons, const Vec2* vertices_W,
                 const Vec2* normals_W, const BlockView& view) {
  std::fill_n(view.inverse, view.askers * kPadded, 0.0F);
  std::fill_n(view.body, view.askers * kPadded, BodyId::kNone);
  // Numbers that were written one by one can only be read together when they have reached the
  // cache: this number of discs is collected first.
  constexpr std::size_t kBatch = 64;
  SeenDiscs<kBatch> seen_discs;
  for (std::size_t begin = 0; begin < discs.pieces.size(); begin += kBatch) {
    const Pieces batch = discs.pieces.subspan(begin, std::min(kBatch, discs.pieces.size() - begin));
    const std::uint16_t* const askers = discs.askers + begin;
    seen_discs.see(batch, [&](std::size_t i) -> const FanPlace& { return view.places[askers[i]]; });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (begin + i < polygons.pieces.size()) {
        // Long before their turn: vertices lie wherever their obstacle stands in the list of all.
        const std::size_t first_vertex = polygons.pieces[begin + i]->first_vertex;
        hwy::Prefetch(vertices_W + first_vertex);
        hwy::Prefetch(vertices_W + first_vertex + 3);
        hwy::Prefetch(normals_W + first_vertex);
        hwy::Prefetch(normals_W + first_vertex + 3);
      }
      if (seen_discs.outside[i] <= 0) {
        cast_all<kPadded>(view, askers[i], AllInside(), batch[i]->body);
      } else {
        cast_all<kPadded>(view, askers[i], seen_discs[i], batch[i]->body);
      }
    }
  }
  // Discs first in every way of casting: of two bodies at equal distance the same one is always
  // named.
  SeenPolygon polygon;
  for (std::size_t i = 0; i < polygons.pieces.size(); ++i) {
    const world::ShapePiece& piece = *polygons.pieces[i];
    const std::size_t asker = polygons.askers[i];
    const Sight sight = polygon.see(piece, vertices_W, normals_W, view.places[asker]);
    if (sight == Sight::kInside) cast_all<kPadded>(view, asker, AllInside(), piece.body);
    if (sight != Sight::kOutside) continue;
    cast_all<kPadded>(view, asker, polygon, piece.body);
  }
}

void cast_block(const SeenBy& discs, const SeenBy& polygons, const Vec2* vertices_W,
                const Vec2* normals_W, const BlockView& view) {
  static_assert(kFewRays == 2 * kRayPadding);
  const auto cast = view.padded == kRayPadding ? cast_padded<kRayPadding> : cast_padded<kFewRays>;
  cast(discs, polygons, vertices_W, normals_W, view);
}

}  // namespace rave::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rave::sim {

HWY_EXPORT(cast_block);

void cast_block(const SeenBy& discs, const SeenBy& polygons, const Vec2* vertices_W,
                const Vec2* normals_W, const BlockView& view) {
  HWY_DYNAMIC_DISPATCH(cast_block)(discs, polygons, vertices_W, normals_W, view);
}

}  // namespace rave::sim
#endif
