// SPDX-License-Identifier: Apache-2.0
#include "candidates.hpp"

#include <cmath>

#include "near_kernel.hpp"

namespace rave::sim {
namespace {

/// Up to here from the grid's origin the floats of PieceColumns are fine enough to choose by.
constexpr double kFloatReach_m = 2048;

/// Adds the pieces of a grid that lie in the surroundings.
void collect(const world::ShapeGrid& grid, const Surroundings& around, Candidates& candidates,
             FanScratch& scratch) {
  const world::PieceColumns columns = grid.columns();
  const Vec2 p = around.p_W - columns.origin;
  if (!(std::abs(p.x) < kFloatReach_m && std::abs(p.y) < kFloatReach_m)) {
    grid.for_each_near(around.p_W, around.reach_m + kRounding_m,
                       [&](const world::ShapePiece& piece) {
                         make_room(scratch, 1);
                         candidates.add(piece);
                       });
    return;
  }
  if (scratch.near.size() < grid.size() + world::kPiecePadding) {
    scratch.near.resize(grid.size() + world::kPiecePadding);
  }
  const NearField field{static_cast<float>(p.x),
                        static_cast<float>(p.y),
                        static_cast<float>(around.reach_m),
                        around.field,
                        static_cast<float>(around.right_W.x),
                        static_cast<float>(around.right_W.y),
                        static_cast<float>(around.left_W.x),
                        static_cast<float>(around.left_W.y)};
  const std::size_t count =
      select_near(grid, grid.cells_near(around.p_W, around.reach_m), field, scratch.near.data());
  make_room(scratch, count + 1);
  for (std::size_t i = 0; i < count; ++i) candidates.add(grid.piece(scratch.near[i]));
}

}  // namespace

void put_in_order(FanScratch& scratch) {
  const auto order = [](std::vector<const world::ShapePiece*>& list, std::size_t& count) {
    const auto begin = list.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    std::sort(begin, end, [](const auto* a, const auto* b) { return a->shape < b->shape; });
    const auto last =
        std::unique(begin, end, [](const auto* a, const auto* b) { return a->shape == b->shape; });
    count = static_cast<std::size_t>(last - begin);
  };
  order(scratch.discs, scratch.disc_count);
  order(scratch.polygons, scratch.polygon_count);
}

void collect(const world::Snapshot& world, const Surroundings& around, Candidates candidates,
             FanScratch& scratch) {
  collect(world.standing(), around, candidates, scratch);
  collect(world.moving(), around, candidates, scratch);
  put_in_order(scratch);
}

}  // namespace rave::sim
