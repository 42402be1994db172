// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/world/shape_grid.hpp"

namespace rave::sim {

/// Puts the indexes of those pieces of `rows` that come within `radius_m` of (x_m, y_m), in their
/// order, into `found`, and returns how many there are. Positions are those of `columns`. As it
/// reckons in floats, a piece that is up to a millimetre farther away may be among them. `found`
/// has room for all pieces of the rows and 16 more. The same with all instruction sets.
[[nodiscard]] std::size_t select_near(const world::PieceColumns& columns,
                                      std::span<const world::PieceRow> rows, float x_m, float y_m,
                                      float radius_m, std::uint32_t* found);

}  // namespace rave::sim
