// SPDX-License-Identifier: Apache-2.0
// An occupancy grid: sums of log odds per cell (S. Thrun, W. Burgard, D. Fox, Probabilistic
// Robotics, 2005, chapter 9). Beams are followed from cell to cell (J. Amanatides and A. Woo,
// Eurographics 1987).
#include "rave/estimate/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/base/check.hpp"
#include "rave/math/exponential.hpp"
#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

constexpr std::size_t kMostCells = 100'000'000;
constexpr double kFar = std::numeric_limits<double>::infinity();

/// The traversal along one axis: direction of the cells, distance to the next border, and distance
/// between borders, both as lengths along the ray.
struct Stride {
  int step = 0;
  double next_m = kFar;
  double apart_m = kFar;
};

Stride stride_of(double from_cells, double direction, double resolution_m) {
  if (direction == 0) return {};
  const double cell = std::floor(from_cells);
  const double border = direction > 0 ? cell + 1 : cell;
  return {direction > 0 ? 1 : -1, (border - from_cells) * resolution_m / direction,
          resolution_m / std::abs(direction)};
}

}  // namespace

Result<OccupancyGrid> OccupancyGrid::create(const GridFrame& frame, const BeamModel& model) {
  if (!(frame.resolution_m > 0) || frame.columns <= 0 || frame.rows <= 0 ||
      frame.cell_count() > kMostCells) {
    return fail(ErrorCode::kInvalidArgument,
                "a grid of {} x {} cells of {} m: expected 1 to {} cells of a positive size",
                frame.columns, frame.rows, frame.resolution_m, kMostCells);
  }
  return OccupancyGrid(frame, model);
}

OccupancyGrid::OccupancyGrid(const GridFrame& frame, const BeamModel& model)
    : frame_(frame),
      model_(model),
      log_odds_(frame.cell_count(), 0.0),
      last_scan_(frame.cell_count(), 0) {}

void OccupancyGrid::add(const ScanView& scan) {
  RAVE_CHECK(scan.bearings_rad.size() == scan.ranges_m.size());
  // The number of the scan marks cells that it has changed, so nothing has to be cleared between
  // scans; the sign tells an end from a passage.
  ++scan_;
  const auto direction_of = [&](std::size_t i) {
    const SinCos turn = sincos(scan.X_WS.yaw + scan.bearings_rad[i]);
    return Vec2{turn.cos, turn.sin};
  };
  // Ends first: within a scan, a cell with an end is not free because another beam passes it.
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (range_m <= model_.range_max_m) {
      mark_end(scan.X_WS.position() + range_m * direction_of(i));
    }
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (std::isnan(range_m)) continue;
    const bool returned = range_m < kFar;
    const double free_m =
        returned ? std::min(range_m, model_.range_max_m) : model_.no_return_free_m;
    if (free_m > 0) trace(scan.X_WS.position(), direction_of(i), free_m);
  }
}

double OccupancyGrid::probability(int column, int row) const noexcept {
  return 1.0 / (1.0 + exp(-log_odds(column, row)));
}

void OccupancyGrid::mark_end(Vec2 p_W) {
  const double x = std::floor((p_W.x - frame_.origin_W.x) / frame_.resolution_m);
  const double y = std::floor((p_W.y - frame_.origin_W.y) / frame_.resolution_m);
  if (!(x >= 0 && x < frame_.columns && y >= 0 && y < frame_.rows)) return;
  const std::size_t at = index(static_cast<int>(x), static_cast<int>(y));
  // Once per scan, however many beams end here: beams of one scan are no independent evidence.
  if (last_scan_[at] == -scan_) return;
  last_scan_[at] = -scan_;
  // Limited, so that a cell can be learnt anew when something has moved.
  log_odds_[at] = std::min(log_odds_[at] + model_.log_odds_hit, model_.log_odds_limit);
}

void OccupancyGrid::trace(Vec2 from_W, Vec2 direction, double length_m) {
  const double x = (from_W.x - frame_.origin_W.x) / frame_.resolution_m;
  const double y = (from_W.y - frame_.origin_W.y) / frame_.resolution_m;
  // Beams of a sensor outside of the grid are ignored; it rarely sees into the grid.
  if (!(x >= 0 && x < frame_.columns && y >= 0 && y < frame_.rows)) return;
  int column = static_cast<int>(x);
  int row = static_cast<int>(y);
  Stride along_x = stride_of(x, direction.x, frame_.resolution_m);
  Stride along_y = stride_of(y, direction.y, frame_.resolution_m);
  // From border to border of the cells, always the nearer one of both axes.
  while (true) {
    pass(column, row);
    const bool to_x = along_x.next_m < along_y.next_m;
    Stride& stride = to_x ? along_x : along_y;
    if (!(stride.next_m < length_m)) return;
    (to_x ? column : row) += stride.step;
    stride.next_m += stride.apart_m;
    if (column < 0 || column >= frame_.columns || row < 0 || row >= frame_.rows) return;
  }
}

void OccupancyGrid::pass(int column, int row) {
  const std::size_t at = index(column, row);
  if (last_scan_[at] == scan_ || last_scan_[at] == -scan_) return;
  last_scan_[at] = scan_;
  log_odds_[at] = std::max(log_odds_[at] + model_.log_odds_pass, -model_.log_odds_limit);
}

}  // namespace rave::estimate
