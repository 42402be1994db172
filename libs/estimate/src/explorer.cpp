// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/explorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rave::estimate {
namespace {

/// Log odds above which a cell is an obstacle: at first on suspicion, and only what is certain if
/// that leaves no way. The arc of a sonar across a door looks like a wall from afar.
constexpr double kSuspected = 0.8;
constexpr double kCertain = 2.2;
constexpr double kDiagonal = 1.41421356237309505;
constexpr double kUnreached = std::numeric_limits<double>::infinity();
/// A robot that touches a wall may leave it: from blocked cells near its start it continues, at a
/// price.
constexpr int kEscapeCells = 2;
constexpr double kEscapeFactor = 10;

constexpr int kSteps[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};

}  // namespace

void Explorer::look(const OccupancyGrid& grid, double blocked_log_odds) {
  blocked_log_odds_ = blocked_log_odds;
  const GridFrame& frame = grid.frame();
  factor_ = std::max(1, static_cast<int>(std::lround(options_.cell_m / frame.resolution_m)));
  columns_ = frame.columns / factor_;
  rows_ = frame.rows / factor_;
  const std::size_t count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  kinds_.resize(count);
  given_up_.resize(count, 0);
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      kinds_[static_cast<std::size_t>(row * columns_ + column)] = kind_of(grid, column, row);
    }
  }
}

Explorer::Kind Explorer::kind_of(const OccupancyGrid& grid, int column, int row) const {
  const GridFrame& frame = grid.frame();
  const int margin = static_cast<int>(std::ceil(options_.clearance_m / frame.resolution_m));
  int known = 0;
  for (int y = row * factor_ - margin; y < (row + 1) * factor_ + margin; ++y) {
    for (int x = column * factor_ - margin; x < (column + 1) * factor_ + margin; ++x) {
      if (x < 0 || y < 0 || x >= frame.columns || y >= frame.rows) continue;
      if (grid.log_odds(x, y) > blocked_log_odds_) return Kind::kBlocked;
      const bool inside = x / factor_ == column && y / factor_ == row;
      if (inside && grid.seen(x, y)) ++known;
    }
  }
  return 2 * known > factor_ * factor_ ? Kind::kFree : Kind::kUnknown;
}

std::int32_t Explorer::cell_of(const OccupancyGrid& grid, Vec2 p_W) const {
  const GridFrame& frame = grid.frame();
  const double cell_m = factor_ * frame.resolution_m;
  const double x = std::floor((p_W.x - frame.origin_W.x) / cell_m);
  const double y = std::floor((p_W.y - frame.origin_W.y) / cell_m);
  if (!(x >= 0 && x < columns_ && y >= 0 && y < rows_)) return -1;
  return static_cast<std::int32_t>(y) * columns_ + static_cast<std::int32_t>(x);
}

Vec2 Explorer::middle_of(const OccupancyGrid& grid, std::int32_t cell) const {
  const GridFrame& frame = grid.frame();
  const double cell_m = factor_ * frame.resolution_m;
  return {frame.origin_W.x + (cell % columns_ + 0.5) * cell_m,
          frame.origin_W.y + (cell / columns_ + 0.5) * cell_m};
}

bool Explorer::is_frontier(std::int32_t cell) const {
  const auto at = static_cast<std::size_t>(cell);
  if (kinds_[at] != Kind::kFree || given_up_[at] != 0) return false;
  const int column = cell % columns_;
  const int row = cell / columns_;
  for (int i = 0; i < 4; ++i) {
    const int x = column + kSteps[i][0];
    const int y = row + kSteps[i][1];
    if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
    if (kinds_[static_cast<std::size_t>(y * columns_ + x)] == Kind::kUnknown) return true;
  }
  return false;
}

template <class Found>
std::int32_t Explorer::search(std::int32_t start, bool through_unknown, const Found& found) {
  costs_.assign(kinds_.size(), kUnreached);
  before_.assign(kinds_.size(), -1);
  // Equal costs in the order of cells, so that a plan does not depend on the heap.
  const auto later = [](const Open& a, const Open& b) {
    return a.cost != b.cost ? a.cost > b.cost : a.cell > b.cell;
  };
  open_.assign(1, {0, start});
  costs_[static_cast<std::size_t>(start)] = 0;
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), later);
    const Open from = open_.back();
    open_.pop_back();
    if (from.cost > costs_[static_cast<std::size_t>(from.cell)]) continue;
    if (found(from.cell)) return from.cell;
    for (const auto& step : kSteps) {
      const int x = from.cell % columns_ + step[0];
      const int y = from.cell / columns_ + step[1];
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      const std::int32_t cell = y * columns_ + x;
      const auto at = static_cast<std::size_t>(cell);
      double factor = 1;
      if (kinds_[at] == Kind::kUnknown) {
        if (!through_unknown) continue;
        factor = options_.unknown_factor;
      } else if (kinds_[at] == Kind::kBlocked) {
        const bool near = std::abs(x - start % columns_) <= kEscapeCells &&
                          std::abs(y - start / columns_) <= kEscapeCells;
        if (!near) continue;
        factor = kEscapeFactor;
      }
      const double cost = from.cost + factor * (step[0] != 0 && step[1] != 0 ? kDiagonal : 1.0);
      if (!(cost < costs_[at])) continue;
      costs_[at] = cost;
      before_[at] = from.cell;
      open_.push_back({cost, cell});
      std::push_heap(open_.begin(), open_.end(), later);
    }
  }
  return -1;
}

void Explorer::trace(const OccupancyGrid& grid, std::int32_t cell, std::vector<Vec2>& way_W) const {
  for (std::int32_t at = cell; at >= 0; at = before_[static_cast<std::size_t>(at)]) {
    way_W.push_back(middle_of(grid, at));
  }
  std::reverse(way_W.begin(), way_W.end());
}

bool Explorer::to_frontier(const OccupancyGrid& grid, Vec2 from_W, std::optional<Vec2> keep_W,
                           std::vector<Vec2>& way_W) {
  return find_frontier(grid, kSuspected, from_W, keep_W, way_W) ||
         find_frontier(grid, kCertain, from_W, keep_W, way_W);
}

bool Explorer::find_frontier(const OccupancyGrid& grid, double blocked_log_odds, Vec2 from_W,
                             std::optional<Vec2> keep_W, std::vector<Vec2>& way_W) {
  look(grid, blocked_log_odds);
  way_W.clear();
  const std::int32_t start = cell_of(grid, from_W);
  if (start < 0) return false;
  std::int32_t kept = keep_W ? cell_of(grid, *keep_W) : -1;
  if (kept >= 0 && !is_frontier(kept)) kept = -1;
  std::int32_t end = -1;
  if (kept >= 0) end = search(start, false, [kept](std::int32_t cell) { return cell == kept; });
  if (end < 0) {
    end =
        search(start, false, [&](std::int32_t cell) { return cell != start && is_frontier(cell); });
  }
  if (end < 0) return false;
  trace(grid, end, way_W);
  return true;
}

bool Explorer::to_goal(const OccupancyGrid& grid, Vec2 from_W, Vec2 goal_W,
                       std::vector<Vec2>& way_W) {
  return find_goal(grid, kSuspected, from_W, goal_W, way_W) ||
         find_goal(grid, kCertain, from_W, goal_W, way_W);
}

bool Explorer::find_goal(const OccupancyGrid& grid, double blocked_log_odds, Vec2 from_W,
                         Vec2 goal_W, std::vector<Vec2>& way_W) {
  look(grid, blocked_log_odds);
  way_W.clear();
  const std::int32_t start = cell_of(grid, from_W);
  const std::int32_t goal = cell_of(grid, goal_W);
  if (start < 0 || goal < 0) return false;
  const std::int32_t end = search(start, true, [goal](std::int32_t cell) { return cell == goal; });
  if (end < 0) return false;
  trace(grid, end, way_W);
  way_W.back() = goal_W;
  return true;
}

void Explorer::give_up(const OccupancyGrid& grid, Vec2 p_W, double radius_m) {
  look(grid, kSuspected);
  for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(kinds_.size()); ++cell) {
    if (squared_norm(middle_of(grid, cell) - p_W) <= radius_m * radius_m) {
      given_up_[static_cast<std::size_t>(cell)] = 1;
    }
  }
}

}  // namespace rave::estimate
