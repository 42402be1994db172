// SPDX-License-Identifier: Apache-2.0
// Chooses the pieces near a sensor from the columns of a grid, 4 to 16 at a time.
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

using Floats = hn::CappedTag<float, world::kPiecePadding>;

/// Which discs of radius `reach` about (dx, dy) reach to the left of the field's right edge and to
/// the right of its left edge; of a field beyond half a circle, to one of them.
template <class V>
HWY_INLINE auto in_field(const NearField& field, V dx, V dy, V reach) {
  const Floats d;
  // Edges are unit vectors, so cross products are distances from the lines through them. What lies
  // behind the sensor may pass; it costs time and changes no reading.
  const auto from_right =
      hn::Sub(hn::Mul(hn::Set(d, field.right_x), dy), hn::Mul(hn::Set(d, field.right_y), dx));
  const auto to_left =
      hn::Sub(hn::Mul(hn::Set(d, field.left_y), dx), hn::Mul(hn::Set(d, field.left_x), dy));
  const auto outside = hn::Neg(reach);
  const auto right = hn::Ge(from_right, outside);
  const auto left = hn::Ge(to_left, outside);
  return field.field.beyond_half ? hn::Or(right, left) : hn::And(right, left);
}

std::size_t select_near(const world::ShapeGrid& grid, const world::CellBlock& block,
                        const NearField& field, std::uint32_t* found) {
  const world::PieceColumns columns = grid.columns();
  const Floats d;
  const hn::RebindToUnsigned<Floats> words;
  const auto x = hn::Set(d, field.x_m);
  const auto y = hn::Set(d, field.y_m);
  const auto radius = hn::Set(d, field.radius_m);
  std::size_t count = 0;
  for (int y_cell = block.y0; y_cell <= block.y1; ++y_cell) {
    const world::PieceRow row = grid.row_of(block, y_cell);
    for (std::uint32_t i = row.begin; i < row.end; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
      const auto dx = hn::Sub(hn::LoadU(d, columns.x_m + i), x);
      const auto dy = hn::Sub(hn::LoadU(d, columns.y_m + i), y);
      const auto own = hn::LoadU(d, columns.reach_m + i);
      const auto reach = hn::Add(own, radius);
      auto near = hn::Le(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(reach, reach));
      if (field.field.limited) near = hn::And(near, in_field(field, dx, dy, own));
      // The last vector of a row reads into the next one, or into the padding of the columns.
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

std::size_t select_near(const world::ShapeGrid& grid, const world::CellBlock& block,
                        const NearField& field, std::uint32_t* found) {
  return HWY_DYNAMIC_DISPATCH(select_near)(grid, block, field, found);
}

}  // namespace rave::sim
#endif
