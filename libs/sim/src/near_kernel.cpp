// SPDX-License-Identifier: Apache-2.0
#include "near_kernel.hpp"

// Compiled once for each set of instructions.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/near_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rave::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

std::size_t select_near(const world::PieceColumns& columns, std::span<const world::PieceRow> rows,
                        float x_m, float y_m, float radius_m, std::uint32_t* found) {
  const hn::CappedTag<float, world::kPiecePadding> d;
  const hn::RebindToUnsigned<decltype(d)> words;
  const auto x = hn::Set(d, x_m);
  const auto y = hn::Set(d, y_m);
  const auto radius = hn::Set(d, radius_m);
  std::size_t count = 0;
  for (const world::PieceRow& row : rows) {
    for (std::uint32_t i = row.begin; i < row.end; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const auto dx = hn::Sub(hn::LoadU(d, columns.x_m + i), x);
      const auto dy = hn::Sub(hn::LoadU(d, columns.y_m + i), y);
      const auto reach = hn::Add(hn::LoadU(d, columns.reach_m + i), radius);
      const auto near = hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(reach, reach));
      const auto in_row = hn::FirstN(d, row.end - i);
      count += hn::CompressStore(hn::Iota(words, i), hn::RebindMask(words, hn::And(near, in_row)),
                                 words, found + count);
    }
  }
  return count;
}

}  // namespace rave::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rave::sim {

HWY_EXPORT(select_near);

std::size_t select_near(const world::PieceColumns& columns, std::span<const world::PieceRow> rows,
                        float x_m, float y_m, float radius_m, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(select_near)(columns, rows, x_m, y_m, radius_m, found);
}

}  // namespace rave::sim
#endif
