// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

namespace rave::maps {

/// Cells along each side of a tile; fewer at the right and upper edge of a map.
inline constexpr std::uint32_t kTileCells = 64;
/// The value of an unknown cell; others are percent, 0 to 100.
inline constexpr std::uint8_t kUnknown = 255;
/// The robot of a global map.
inline constexpr std::uint32_t kNoRobot = 0xffffffff;

/// The cells of a map in the world frame: the lower left corner of cell (0, 0) is the origin,
/// columns run along x, rows along y.
struct MapFrame {
  double resolution_m = 0.1;
  Vec2 origin_W;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  /// Number of cells along a side of tile `tile`, if the map has `cells` in that direction; 0: no
  /// such tile.
  [[nodiscard]] static constexpr std::uint32_t side(std::uint32_t cells,
                                                    std::uint32_t tile) noexcept {
    const std::uint64_t first = std::uint64_t{tile} * kTileCells;
    if (first >= cells) return 0;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(kTileCells, cells - first));
  }
  [[nodiscard]] bool operator==(const MapFrame& other) const noexcept {
    return resolution_m == other.resolution_m && origin_W.x == other.origin_W.x &&
           origin_W.y == other.origin_W.y && columns == other.columns && rows == other.rows;
  }
};

/// A self-contained part of a map. For tiles of one place, the newest counts. A value.
struct MapTile {
  std::string source;              ///< Name of the robot or of the global map.
  std::uint32_t robot = kNoRobot;  ///< For a local map: index of its robot in the roster.
  MapFrame frame;                  ///< Frame of the whole map.
  std::uint32_t column = 0;        ///< Position of the tile, in tiles.
  std::uint32_t row = 0;
  std::uint32_t revision = 0;  ///< Counts the versions of this tile at its sender, from 1.
  SimTime stamp;               ///< Stamp of the newest reading in it.
  /// Row by row, probability that a cell is occupied in percent, or kUnknown.
  std::vector<std::uint8_t> cells;
};

}  // namespace rave::maps
