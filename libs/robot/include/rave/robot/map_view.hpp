// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/math/pose.hpp"

namespace rave {

/// The map that a program has made, for those who want to see it. Views of arrays of the program;
/// valid until its next decision. Cells are numbered row by row: columns run along x, rows along y,
/// and the lower left corner of the first is the origin.
struct MapView {
  double resolution_m = 0;
  Vec2 origin_W;
  std::uint32_t columns = 0;           ///< A multiple of 64.
  std::uint32_t rows = 0;              ///< A multiple of 64.
  const double* log_odds = nullptr;    ///< Of "occupied", natural logarithm; null: no map yet.
  const std::int32_t* seen = nullptr;  ///< For each cell: not 0 if something is known of it.
  /// For each tile of 64 x 64 cells, row by row: a number that grows when it may have changed.
  const std::uint32_t* touched = nullptr;
  std::int64_t stamp_ns = 0;  ///< Of the newest reading in it.
};

}  // namespace rave
