// SPDX-License-Identifier: Apache-2.0
#include "rave/world/grid.hpp"

#include <algorithm>
#include <cmath>

namespace rave::world {
namespace {

constexpr double kMaxCells = 1 << 20;

int clamp_cell(double cell, int count) noexcept {
  if (!(cell > 0)) return 0;
  return cell >= count ? count - 1 : static_cast<int>(cell);
}

}  // namespace

void Grid::build(std::span<const GridItem> items, double cell_m) {
  width_ = 0;
  height_ = 0;
  sorted_.clear();
  if (items.empty()) return;
  Vec2 low = items.front().centre;
  Vec2 high = low;
  for (const GridItem& item : items) {
    low = {std::min(low.x, item.centre.x - item.radius_m),
           std::min(low.y, item.centre.y - item.radius_m)};
    high = {std::max(high.x, item.centre.x + item.radius_m),
            std::max(high.y, item.centre.y + item.radius_m)};
  }
  const double cell =
      std::max(cell_m, std::sqrt((high.x - low.x) * (high.y - low.y) / kMaxCells) + 1e-9);
  origin_ = low;
  cells_per_m_ = 1.0 / cell;
  width_ = static_cast<int>(std::min((high.x - low.x) * cells_per_m_, kMaxCells)) + 1;
  height_ = static_cast<int>(std::min((high.y - low.y) * cells_per_m_, kMaxCells)) + 1;

  begin_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  const auto for_each_cell = [&](const GridItem& item, auto&& visit) {
    const CellRange range = cells_of(item.centre, item.radius_m);
    for (int y = range.y0; y <= range.y1; ++y) {
      for (int x = range.x0; x <= range.x1; ++x) {
        visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
              static_cast<std::size_t>(x));
      }
    }
  };
  std::uint32_t total = 0;
  for (const GridItem& item : items) {
    for_each_cell(item, [&](std::size_t cell_index) {
      ++begin_[cell_index];
      ++total;
    });
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin_) {
    sum += count;
    count = sum;
  }
  sorted_.resize(total);
  // Backwards, so that items of one cell end up in their order.
  for (std::size_t i = items.size(); i-- > 0;) {
    for_each_cell(items[i],
                  [&](std::size_t cell_index) { sorted_[--begin_[cell_index]] = items[i]; });
  }
}

Grid::CellRange Grid::cells_of(Vec2 centre, double radius_m) const noexcept {
  return {clamp_cell((centre.x - radius_m - origin_.x) * cells_per_m_, width_),
          clamp_cell((centre.x + radius_m - origin_.x) * cells_per_m_, width_),
          clamp_cell((centre.y - radius_m - origin_.y) * cells_per_m_, height_),
          clamp_cell((centre.y + radius_m - origin_.y) * cells_per_m_, height_)};
}

void Grid::gather(Vec2 p, double radius_m, std::vector<std::uint32_t>& found) const {
  if (width_ == 0) return;
  const CellRange range = cells_of(p, radius_m);
  for (int y = range.y0; y <= range.y1; ++y) {
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    const std::uint32_t first = begin_[row + static_cast<std::size_t>(range.x0)];
    const std::uint32_t last = begin_[row + static_cast<std::size_t>(range.x1) + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const GridItem& item = sorted_[i];
      const double reach = radius_m + item.radius_m;
      if (squared_norm(item.centre - p) <= reach * reach) found.push_back(item.index);
    }
  }
}

}  // namespace rave::world
