// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/map_save.hpp"

#include <algorithm>

#include "rave/base/file.hpp"
#include "rave/estimate/map_files.hpp"

namespace rave::maps {
namespace {

void put(const MapTile& tile, std::uint32_t columns, std::vector<std::uint8_t>& cells) {
  const std::uint32_t width = MapFrame::side(tile.frame.columns, tile.column);
  for (std::uint32_t i = 0; width > 0 && i < tile.cells.size(); ++i) {
    const std::size_t row = std::size_t{tile.row} * kTileCells + i / width;
    const std::size_t column = std::size_t{tile.column} * kTileCells + i % width;
    if (row * columns + column < cells.size()) cells[row * columns + column] = tile.cells[i];
  }
}

}  // namespace

Status save(const std::vector<MapTile>& tiles, const std::filesystem::path& base) {
  if (tiles.empty()) return fail(ErrorCode::kInvalidArgument, "the map has no known cell yet");
  // The newest frame: a global map grows.
  const MapFrame frame = tiles.back().frame;
  std::vector<std::uint8_t> cells(std::size_t{frame.columns} * frame.rows, kUnknown);
  for (const MapTile& tile : tiles) {
    if (tile.frame == frame) put(tile, frame.columns, cells);
  }
  const estimate::GridFrame grid{frame.resolution_m, frame.origin_W,
                                 static_cast<int>(frame.columns), static_cast<int>(frame.rows)};
  const std::filesystem::path image = base.string() + ".pgm";
  RAVE_TRY(write_private_file_atomically(image, estimate::map_image(grid, cells, {})));
  return write_private_file_atomically(
      base.string() + ".yaml",
      estimate::map_yaml(grid, {}, image.filename().string(),
                         "# The map `" + tiles.back().source + "` of a run of RAVE.\n"));
}

}  // namespace rave::maps
