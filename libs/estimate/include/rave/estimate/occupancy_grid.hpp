// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave::estimate {

/// The cells of a grid in the world frame: the lower left corner of cell (0, 0) is the origin,
/// columns run along x, rows along y.
struct GridFrame {
  double resolution_m = 0.05;
  Vec2 origin_W;
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::size_t cell_count() const noexcept {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
};

/// The change of a cell's log odds (natural logarithm of the odds of "occupied") by one beam.
struct BeamModel {
  double log_odds_hit = 0.85;   ///< Added to the cell in which a beam ends.
  double log_odds_pass = -0.4;  ///< Added to cells that a beam crosses.
  double log_odds_limit = 4.0;  ///< Bound of |log odds|, so that a cell can still change.
  double range_max_m = 30;      ///< A longer beam counts up to this range, without an end.
  double no_return_free_m = 0;  ///< Range up to which a beam without return marks cells free.
};

/// The beams of one scan in the sensor frame.
struct ScanView {
  Pose2 X_WS;
  std::span<const double> bearings_rad;
  std::span<const float> ranges_m;  ///< One per bearing; +infinity: no return; NaN: not known.
};

/// One reading of a cone sensor, such as a sonar, in the sensor frame.
struct ConeView {
  Pose2 X_WS;
  double bearing_rad = 0;  ///< Of its axis.
  double cone_rad = 0;     ///< Full opening angle.
  double range_m = 0;      ///< +infinity: no return.
};

/// An occupancy grid by the log-odds form of Bayes' rule, cells independent of one another:
/// H. Moravec, A. Elfes: "High resolution maps from wide angle sonar", ICRA 1985; S. Thrun, W.
/// Burgard, D. Fox: "Probabilistic Robotics", MIT Press 2005, chapter 9. Beams are traced cell by
/// cell: J. Amanatides, A. Woo: "A fast voxel traversal algorithm for ray tracing", Eurographics
/// 1987. Within one scan a cell counts once, and an end outweighs the beams that pass: near the
/// sensor many beams share a cell, and beams that graze a wall would wear it away.
///
/// A value type; one thread at a time. Same input, same bits.
class OccupancyGrid {
 public:
  /// Errors (kInvalidArgument): no cells, more than 100 million cells, a resolution that is not
  /// positive.
  [[nodiscard]] static Result<OccupancyGrid> create(const GridFrame& frame, const BeamModel& model);

  [[nodiscard]] const GridFrame& frame() const noexcept { return frame_; }
  /// Adds a scan. Beams outside of the grid are ignored. Precondition: both spans have the same
  /// size.
  void add(const ScanView& scan);
  /// Adds a cone: the echo may come from anywhere on its arc, and everything nearer is free. Cells
  /// off the axis count less. The end is shared among the cells of the arc by their probability of
  /// being occupied: what is known as free cannot have been the echo. NaN is ignored.
  void add(const ConeView& cone);

  /// The log odds of a cell; 0 if nothing is known.
  [[nodiscard]] double log_odds(int column, int row) const noexcept {
    return log_odds_[index(column, row)];
  }
  /// Whether any beam has reached the cell.
  [[nodiscard]] bool seen(int column, int row) const noexcept {
    return last_scan_[index(column, row)] != 0;
  }
  /// Probability that the cell is occupied, 0 to 1.
  [[nodiscard]] double probability(int column, int row) const noexcept;
  /// All log odds, row by row.
  [[nodiscard]] std::span<const double> all_log_odds() const noexcept { return log_odds_; }
  /// For each cell, not 0 if any beam has reached it.
  [[nodiscard]] std::span<const std::int32_t> all_seen() const noexcept { return last_scan_; }
  /// A number that depends on every change of every cell so far, in their order.
  [[nodiscard]] std::uint64_t digest() const noexcept { return digest_; }

 private:
  OccupancyGrid(const GridFrame& frame, const BeamModel& model);

  [[nodiscard]] std::size_t index(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame_.columns) +
           static_cast<std::size_t>(column);
  }
  void mark_end(Vec2 p_W);
  void trace(Vec2 from_W, Vec2 direction, double length_m);
  void pass(int column, int row);
  void change(std::size_t at, double by);
  void find_arc(const ConeView& cone, double free_m);

  GridFrame frame_;
  BeamModel model_;
  std::vector<double> log_odds_;
  /// Number of the last scan that touched the cell, from 1; 0: none; negative if a beam of that
  /// scan ended in it.
  std::vector<std::int32_t> last_scan_;
  std::int32_t scan_ = 0;
  std::uint64_t digest_ = 0;
  struct ArcCell {
    std::size_t at = 0;
    double share = 0;
  };
  std::vector<ArcCell> arc_;  ///< Memory of add().
};

}  // namespace rave::estimate
