// SPDX-License-Identifier: Apache-2.0
// Occupied cells of a map as few rectangles: a wall of a thousand cells becomes one body.
#include "rave/config/map_image.hpp"

namespace rave::config {
namespace {

/// The occupied cells not covered by a rectangle yet.
class Rest {
 public:
  explicit Rest(const MapImage& map)
      : width_(map.width), height_(map.height), open_(map.cells.size()) {
    for (std::size_t i = 0; i < open_.size(); ++i) {
      open_[i] = map.cells[i] == CellState::kOccupied ? 1 : 0;
    }
  }

  [[nodiscard]] bool has(int column, int row) const { return open_[index(column, row)] != 0; }

  /// The largest rectangle with this top left cell that grows right first, then down.
  [[nodiscard]] CellRectangle grow_right(int column, int row) const {
    CellRectangle r{column, row, 1, 1};
    while (column + r.width < width_ && has(column + r.width, row)) ++r.width;
    while (row + r.height < height_ && all_of({column, row + r.height, r.width, 1})) ++r.height;
    return r;
  }
  /// Likewise, down first.
  [[nodiscard]] CellRectangle grow_down(int column, int row) const {
    CellRectangle r{column, row, 1, 1};
    while (row + r.height < height_ && has(column, row + r.height)) ++r.height;
    while (column + r.width < width_ && all_of({column + r.width, row, 1, r.height})) ++r.width;
    return r;
  }
  void remove(const CellRectangle& r) {
    for (int y = r.row; y < r.row + r.height; ++y) {
      for (int x = r.column; x < r.column + r.width; ++x) open_[index(x, y)] = 0;
    }
  }

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] bool all_of(const CellRectangle& r) const {
    for (int y = r.row; y < r.row + r.height; ++y) {
      for (int x = r.column; x < r.column + r.width; ++x) {
        if (!has(x, y)) return false;
      }
    }
    return true;
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> open_;
};

std::int64_t area(const CellRectangle& r) { return std::int64_t{r.width} * r.height; }

}  // namespace

// Greedy, from the top left: not the fewest rectangles, but each occupied cell is in exactly one,
// and walls become single ones. Both directions are tried, since walls may run either way.
std::vector<CellRectangle> cell_rectangles_of(const MapImage& map) {
  Rest rest(map);
  std::vector<CellRectangle> rectangles;
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      if (!rest.has(column, row)) continue;
      const CellRectangle right = rest.grow_right(column, row);
      const CellRectangle down = rest.grow_down(column, row);
      rectangles.push_back(area(down) > area(right) ? down : right);
      rest.remove(rectangles.back());
    }
  }
  return rectangles;
}

std::vector<MapRectangle> rectangles_of(const MapImage& map) {
  std::vector<MapRectangle> rectangles;
  for (const CellRectangle& r : cell_rectangles_of(map)) {
    // Row 0 is the top: its upper edge is at y = height.
    rectangles.push_back(
        {r.column * map.resolution_m, (map.height - r.row - r.height) * map.resolution_m,
         (r.column + r.width) * map.resolution_m, (map.height - r.row) * map.resolution_m});
  }
  return rectangles;
}

}  // namespace rave::config
