// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/math/pose.hpp"

namespace rave::world {

/// A disc to be found again by place.
struct GridItem {
  Vec2 centre;
  double radius_m = 0;
  std::uint32_t index = 0;
};

/// A uniform grid over discs, built by counting sort. An item lies in every cell that its bounding
/// square touches, so a query need not know the largest radius. Build once, then query from many
/// threads. No allocation when rebuilt with no more items than before.
class Grid {
 public:
  /// Cells are `cell_m` wide, or wider where the extent would need more than about 2^20 cells.
  void build(std::span<const GridItem> items, double cell_m);

  /// Adds the index of each item whose disc comes within `radius_m` of `p`; an index may come
  /// several times.
  void gather(Vec2 p, double radius_m, std::vector<std::uint32_t>& found) const;

 private:
  struct CellRange {
    int x0 = 0;
    int x1 = 0;
    int y0 = 0;
    int y1 = 0;
  };
  [[nodiscard]] CellRange cells_of(Vec2 centre, double radius_m) const noexcept;

  Vec2 origin_;
  double cells_per_m_ = 1;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint32_t> begin_;  ///< Per cell; one more at the end.
  std::vector<GridItem> sorted_;
};

}  // namespace rave::world
