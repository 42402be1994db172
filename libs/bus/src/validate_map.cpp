// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "rave/bus/validate.hpp"
#include "sample_checks.hpp"

namespace rave::bus {
namespace {

constexpr double kFinestCell_m = 1e-3;
constexpr double kCoarsestCell_m = 1e3;

/// Number of cells of a tile along one side; 0: no such tile.
std::uint32_t side_of(std::uint32_t cells, std::uint32_t tile) {
  // In 64 bits: the number comes from another process.
  const std::uint64_t first = std::uint64_t{tile} * rave_wire_kTileCells;
  if (first >= cells) return 0;
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(rave_wire_kTileCells, cells - first));
}

Status check_frame(const MapTile& sample) {
  // NaN fails this condition.
  if (!(sample.resolution_m >= kFinestCell_m && sample.resolution_m <= kCoarsestCell_m)) {
    return invalid("resolution_m is {}, not within {} to {}", sample.resolution_m, kFinestCell_m,
                   kCoarsestCell_m);
  }
  RAVE_TRY(check_number("origin_x_m", sample.origin_x_m, kMaxPosition_m));
  RAVE_TRY(check_number("origin_y_m", sample.origin_y_m, kMaxPosition_m));
  for (const std::uint32_t side : {sample.columns, sample.rows}) {
    if (side == 0 || side > rave_wire_kMaxMapCells) {
      return invalid("the map has {} x {} cells; expected 1 to {} along each side", sample.columns,
                     sample.rows, rave_wire_kMaxMapCells);
    }
  }
  return {};
}

}  // namespace

Status validate(const MapTile& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_label("source", sample.source, true));
  RAVE_TRY(check_time("stamp_ns", sample.stamp_ns));
  RAVE_TRY(check_frame(sample));
  if (sample.revision == 0) return invalid("revision is 0");
  const std::uint32_t width = side_of(sample.columns, sample.column);
  const std::uint32_t height = side_of(sample.rows, sample.row);
  if (width * height == 0) {
    return invalid("a map of {} x {} cells has no tile ({}, {})", sample.columns, sample.rows,
                   sample.column, sample.row);
  }
  const auto cells = elements(sample.cells);
  if (cells.size() != std::size_t{width} * height) {
    return invalid("cells has {} entries for a tile of {} x {}", cells.size(), width, height);
  }
  const auto wrong = std::ranges::find_if(
      cells, [](std::uint8_t cell) { return cell > 100 && cell != rave_wire_kCellUnknown; });
  if (wrong == cells.end()) return {};
  return invalid("cells[{}] is {}; expected 0 to 100, or {}", wrong - cells.begin(), *wrong,
                 rave_wire_kCellUnknown);
}

}  // namespace rave::bus
