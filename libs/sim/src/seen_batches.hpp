// SPDX-License-Identifier: Apache-2.0
// Several shapes made out together. As seen_shapes.hpp, included for each set of instructions.
#if defined(RAVE_SIM_SEEN_BATCHES) == defined(HWY_TARGET_TOGGLE)
#ifdef RAVE_SIM_SEEN_BATCHES
#undef RAVE_SIM_SEEN_BATCHES
#else
#define RAVE_SIM_SEEN_BATCHES
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

#include "seen_shapes.hpp"

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

/// Keeps the nearer of what rays have met. `d` is given: from a vector of no fixed size one does
/// not learn how much of it is used.
template <class D, class V>
HWY_INLINE void keep(D d, V inverse, std::uint32_t body, float* kept, std::uint32_t* kept_body) {
  const hn::RebindToUnsigned<D> words;
  auto nearest = hn::LoadU(d, kept);
  auto nearest_body = hn::LoadU(words, kept_body);
  keep_nearer(inverse, body, nearest, nearest_body);
  hn::StoreU(nearest, d, kept);
  hn::StoreU(nearest_body, words, kept_body);
}

using Eight = hn::CappedTag<double, 8>;
using EightFloats = hn::Rebind<float, Eight>;

/// Points of the world, each relative to a sensor, and where they are in its frame. The difference
/// is taken in double, as in to_sensor().
template <std::size_t kBatch>
struct Points {
  HWY_ALIGN double dx[kBatch] = {};
  HWY_ALIGN double dy[kBatch] = {};
  HWY_ALIGN float cos[kBatch] = {};
  HWY_ALIGN float sin[kBatch] = {};
  HWY_ALIGN float x[kBatch] = {};
  HWY_ALIGN float y[kBatch] = {};

  HWY_INLINE void put(std::size_t at, Vec2 p_W, const FanPlace& place) {
    dx[at] = p_W.x - place.x_m;
    dy[at] = p_W.y - place.y_m;
    cos[at] = place.cos;
    sin[at] = place.sin;
  }
  [[nodiscard]] HWY_INLINE Point operator[](std::size_t at) const { return {x[at], y[at]}; }
  HWY_INLINE void turn() {
    const Eight d;
    const EightFloats floats;
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      const auto ux = hn::DemoteTo(floats, hn::LoadU(d, dx + i));
      const auto uy = hn::DemoteTo(floats, hn::LoadU(d, dy + i));
      const auto c = hn::Load(floats, cos + i);
      const auto s = hn::Load(floats, sin + i);
      hn::StoreU(hn::Add(hn::Mul(c, ux), hn::Mul(s, uy)), floats, x + i);
      hn::StoreU(hn::Sub(hn::Mul(c, uy), hn::Mul(s, ux)), floats, y + i);
    }
  }
};

/// Up to kBatch discs made out together; a multiple of 8.
template <std::size_t kBatch>
struct SeenDiscs {
  Points<kBatch> centre;
  HWY_ALIGN float radius[kBatch] = {};
  HWY_ALIGN double outside[kBatch] = {};
  HWY_ALIGN float scale[kBatch] = {};

  /// `place_of(i)` is where the sensor stands that has piece i before it.
  template <class PlaceOf>
  HWY_INLINE void see(Pieces pieces, PlaceOf place_of) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      centre.put(i, pieces[i]->centre_W, place_of(i));
      radius[i] = pieces[i]->radius_m;
    }
    centre.turn();
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
  }
  [[nodiscard]] HWY_INLINE SeenDisc operator[](std::size_t at) const {
    return {centre[at], radius[at], outside[at], scale[at]};
  }
};

}  // namespace rave::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
