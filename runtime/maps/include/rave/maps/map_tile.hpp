// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

namespace rave::maps {

/// Cells along each side of a tile, but for those at the right and upper edge of a map.
inline constexpr std::uint32_t kTileCells = 64;
/// The value of a cell of which nothing is known; others are percent, 0 to 100.
inline constexpr std::uint8_t kUnknown = 255;
/// A map of no robot: a global one.
inline constexpr std::uint32_t kNoRobot = 0xffffffff;

/// Where the cells of a map lie in the world: cell (0, 0) has its lower left corner at the origin,
/// columns go along x, rows along y.
struct MapFrame {
  double resolution_m = 0.1;
  Vec2 origin_W;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  /// Cells along a side of tile `tile`, of so many `cells` of the map; 0: there is no such tile.
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

/// A piece of a map, complete in itself: of several of one place the newest counts. A value.
struct MapTile {
  std::string source;              ///< Name of the robot, or of a global map.
  std::uint32_t robot = kNoRobot;  ///< Whose local map it is; its index in the roster.
  MapFrame frame;                  ///< Of the whole map.
  std::uint32_t column = 0;        ///< Of the tile, in tiles.
  std::uint32_t row = 0;
  std::uint32_t revision = 0;  ///< Of this tile at who made it, from 1.
  SimTime stamp;               ///< Of the newest reading that is in it.
  /// Row by row, probability of "occupied" in percent, or kUnknown.
  std::vector<std::uint8_t> cells;
};

}  // namespace rave::maps
