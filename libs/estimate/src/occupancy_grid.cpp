// SPDX-License-Identifier: Apache-2.0
// An occupancy grid: sums of log odds per cell (S. Thrun, W. Burgard, D. Fox, Probabilistic
// Robotics, 2005, chapter 9). Beams are followed from cell to cell (J. Amanatides and A. Woo,
// Eurographics 1987).
#include "rave/estimate/occupancy_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "rave/base/check.hpp"
#include "rave/base/hash.hpp"
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

// Half a cell's diagonal, so that an arc has no gaps.
constexpr double kHalfArc_cells = 0.75;
// What an edge of the cone counts, relative to its axis.
constexpr double kEdgeWeight = 0.25;
// An end says as much as one of a ray if at most this number of cells could have given it.
constexpr double kSharpCells = 3;

void OccupancyGrid::add(const ConeView& cone) {
  if (std::isnan(cone.range_m)) return;
  ++scan_;
  const bool returned = cone.range_m <= model_.range_max_m;
  const double free_m =
      cone.range_m < kFar ? std::min(cone.range_m, model_.range_max_m) : model_.no_return_free_m;
  arc_.clear();
  find_arc({cone.X_WS, cone.bearing_rad, cone.cone_rad, returned ? cone.range_m : kFar}, free_m);
  double all = 0;
  for (const ArcCell& cell : arc_) all += cell.share;
  for (const ArcCell& cell : arc_) {
    last_scan_[cell.at] = -scan_;
    change(cell.at, model_.log_odds_hit * std::min(1.0, kSharpCells * cell.share / all));
  }
}

/// Frees what lies before the arc, and puts the cells of the arc into `arc_`.
void OccupancyGrid::find_arc(const ConeView& cone, double free_m) {
  const double half_rad = 0.5 * cone.cone_rad;
  const double cell_m = frame_.resolution_m;
  const double thick_m = kHalfArc_cells * cell_m;
  const double reach_m = (cone.range_m < kFar ? cone.range_m : free_m) + thick_m;
  const SinCos edge = sincos(half_rad);
  const SinCos axis = sincos(cone.X_WS.yaw + cone.bearing_rad);
  const auto first = [&](double at, double origin) {
    return static_cast<int>(std::max(0.0, std::floor((at - reach_m - origin) / cell_m)));
  };
  const auto last = [&](double at, double origin, int cells) {
    const double index = std::floor((at + reach_m - origin) / cell_m);
    return static_cast<int>(std::min(index, static_cast<double>(cells - 1)));
  };
  if (!(std::abs(cone.X_WS.x) + std::abs(cone.X_WS.y) < 1e9)) return;
  const int last_row = last(cone.X_WS.y, frame_.origin_W.y, frame_.rows);
  const int last_column = last(cone.X_WS.x, frame_.origin_W.x, frame_.columns);
  for (int row = first(cone.X_WS.y, frame_.origin_W.y); row <= last_row; ++row) {
    const double y = frame_.origin_W.y + (row + 0.5) * cell_m - cone.X_WS.y;
    for (int column = first(cone.X_WS.x, frame_.origin_W.x); column <= last_column; ++column) {
      const double x = frame_.origin_W.x + (column + 0.5) * cell_m - cone.X_WS.x;
      const double ahead_m = axis.cos * x + axis.sin * y;
      const double distance_m = std::sqrt(x * x + y * y);
      // A narrow cone has at least the cells on its axis.
      const double beside_m = std::abs(axis.cos * y - axis.sin * x);
      const bool inside = ahead_m >= distance_m * edge.cos || beside_m <= 0.5 * cell_m;
      if (ahead_m < 0 || distance_m > reach_m || !inside) continue;
      const double off = half_rad > 0 && half_rad < 1.5 && distance_m > 0
                             ? std::min(1.0, beside_m / (distance_m * edge.sin))
                             : 0.0;
      const double weight = 1 - (1 - kEdgeWeight) * off * off;
      const std::size_t at = index(column, row);
      if (std::abs(distance_m - cone.range_m) <= thick_m) {
        arc_.push_back({at, weight * probability(column, row)});
      } else if (distance_m < free_m) {
        last_scan_[at] = scan_;
        change(at, model_.log_odds_pass * weight);
      }
    }
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
  change(at, model_.log_odds_hit);
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
  change(at, model_.log_odds_pass);
}

// Limited, so that a cell can be learnt anew when something has moved.
void OccupancyGrid::change(std::size_t at, double by) {
  double& cell = log_odds_[at];
  const double limit = model_.log_odds_limit;
  const double changed = std::clamp(cell + by, -limit, limit);
  if (changed == cell) return;
  cell = changed;
  digest_ = mix64(digest_ ^ at) + std::bit_cast<std::uint64_t>(changed);
}

}  // namespace rave::estimate
