// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rave/sim/range_engine.hpp"
#include "rave/world/shape_grid.hpp"

namespace rave::sim {

/// What a sensor could see: a disc, or the part of it between two directions.
struct NearField {
  float x_m = 0;  ///< The middle, on the axes and from the origin of the columns.
  float y_m = 0;
  float radius_m = 0;
  FanField field;
  float right_x = 0;  ///< Unit vectors, as the field has them but in W.
  float right_y = 0;
  float left_x = 0;
  float left_y = 0;
};

/// Puts the indexes of those pieces in `block` that come into the field, in their order, into
/// `found`, and returns how many there are. As it reckons in floats, a piece that is up to a
/// millimetre outside may be among them. `found` has room for all pieces of the grid and
/// kPiecePadding more. The same with all instruction sets.
[[nodiscard]] std::size_t select_near(const world::ShapeGrid& grid, const world::CellBlock& block,
                                      const NearField& field, std::uint32_t* found);

}  // namespace rave::sim
