// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "rave/estimate/occupancy_grid.hpp"

namespace rave::estimate {

/// Plans ways through a map: to a goal, or to the nearest frontier, which is free space beside
/// unknown space (B. Yamauchi, "A frontier-based approach for autonomous exploration", CIRA 1997).
/// Plans on cells of about 0.2 m; a cell is passable if nothing within `clearance_m` of it is
/// occupied. A value; one thread at a time. Same input, same bits.
class Explorer {
 public:
  struct Options {
    double cell_m = 0.2;
    double clearance_m = 0.1;
    /// How much farther a cell of unknown space counts on the way to a goal.
    double unknown_factor = 3;
  };
  Explorer() = default;
  explicit Explorer(const Options& options) : options_(options) {}

  /// The way to the nearest frontier, or to the one at `keep` if it is still one: points from the
  /// start on, world frame. False, and no points: there is none that it can reach.
  bool to_frontier(const OccupancyGrid& grid, Vec2 from_W, std::optional<Vec2> keep_W,
                   std::vector<Vec2>& way_W);
  /// The way to a goal, through unknown space if need be. False, and no points: there is none.
  bool to_goal(const OccupancyGrid& grid, Vec2 from_W, Vec2 goal_W, std::vector<Vec2>& way_W);
  /// Frontiers within `radius_m` of a point are not chosen any more.
  void give_up(const OccupancyGrid& grid, Vec2 p_W, double radius_m);

 private:
  enum class Kind : std::uint8_t { kUnknown, kFree, kBlocked };
  struct Open {
    double cost = 0;
    std::int32_t cell = 0;
  };

  void look(const OccupancyGrid& grid, double blocked_log_odds);
  bool find_frontier(const OccupancyGrid& grid, double blocked_log_odds, Vec2 from_W,
                     std::optional<Vec2> keep_W, std::vector<Vec2>& way_W);
  bool find_goal(const OccupancyGrid& grid, double blocked_log_odds, Vec2 from_W, Vec2 goal_W,
                 std::vector<Vec2>& way_W);
  [[nodiscard]] Kind kind_of(const OccupancyGrid& grid, int column, int row) const;
  [[nodiscard]] std::int32_t cell_of(const OccupancyGrid& grid, Vec2 p_W) const;
  [[nodiscard]] Vec2 middle_of(const OccupancyGrid& grid, std::int32_t cell) const;
  [[nodiscard]] bool is_frontier(std::int32_t cell) const;
  /// Computes costs from `start` on, until `found(cell)` is true for a cell, which it returns; -1:
  /// for none.
  template <class Found>
  std::int32_t search(std::int32_t start, bool through_unknown, const Found& found);
  void trace(const OccupancyGrid& grid, std::int32_t cell, std::vector<Vec2>& way_W) const;

  Options options_;
  double blocked_log_odds_ = 0;
  int factor_ = 1;  ///< Cells of the map along a cell of the plan.
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Kind> kinds_;
  std::vector<std::uint8_t> given_up_;
  std::vector<double> costs_;
  std::vector<std::int32_t> before_;
  std::vector<Open> open_;  ///< A heap.
};

}  // namespace rave::estimate
