// SPDX-License-Identifier: Apache-2.0
#include "arena.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/random.hpp"

namespace rave::swarm {
namespace {

constexpr double kAreaPerRobot_m2 = 10;
/// How far a robot may stand from the middle of its cell, as a share of the cell.
constexpr double kJitter = 0.25;
constexpr double kShortestSide_m = 0.4;
constexpr double kLongestSide_m = 1.0;
constexpr double kClearance_m = 0.05;

/// Device numbers under which places are drawn.
constexpr std::uint32_t kRobotPlaces = 0xfffd'0000U;
constexpr std::uint32_t kBoxPlaces = 0xfffd'0001U;

// Zero is added so that there is no -0, which a file would not keep.
double whole_mm(double length_m) { return std::round(length_m * 1000) / 1000 + 0.0; }
double whole_tenths(double angle_deg) { return std::round(angle_deg * 10) / 10 + 0.0; }

/// The cells of the grid, one robot in each of the first ones.
class Grid {
 public:
  Grid(std::uint32_t robots, double side_m)
      : columns_(static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(robots))))),
        side_m_(side_m),
        cell_m_(side_m / columns_) {}

  [[nodiscard]] config::PoseFile place(std::uint32_t robot, std::uint64_t seed) const {
    RandomStream random(seed, robot, kRobotPlaces, 0);
    const double jitter_m = kJitter * cell_m_;
    const double x_m = middle_m(robot % columns_) + random.uniform(-jitter_m, jitter_m);
    const double y_m = middle_m(robot / columns_) + random.uniform(-jitter_m, jitter_m);
    return {whole_mm(x_m), whole_mm(y_m), whole_tenths(random.uniform(-180, 180))};
  }

  /// Whether no robot comes within `reach_m` of a point; less than the side of a cell.
  [[nodiscard]] bool is_free(double x_m, double y_m, double reach_m,
                             const std::vector<config::PoseFile>& robots) const {
    const std::int64_t column = cell_of(x_m);
    const std::int64_t row = cell_of(y_m);
    for (std::int64_t r = row - 1; r <= row + 1; ++r) {
      for (std::int64_t c = column - 1; c <= column + 1; ++c) {
        if (r < 0 || c < 0 || r >= columns_ || c >= columns_) continue;
        const auto robot = static_cast<std::size_t>(r * columns_ + c);
        if (robot >= robots.size()) continue;
        const double dx_m = robots[robot].x_m - x_m;
        const double dy_m = robots[robot].y_m - y_m;
        if (dx_m * dx_m + dy_m * dy_m < reach_m * reach_m) return false;
      }
    }
    return true;
  }

 private:
  [[nodiscard]] double middle_m(std::uint32_t index) const {
    return (index + 0.5) * cell_m_ - side_m_ / 2;
  }
  [[nodiscard]] std::int64_t cell_of(double at_m) const {
    return static_cast<std::int64_t>(std::floor((at_m + side_m_ / 2) / cell_m_));
  }

  std::uint32_t columns_;
  double side_m_;
  double cell_m_;
};

/// A box that no robot stands in. Three of four places are free, so a few tries are enough.
Box make_box(std::uint32_t index, std::uint64_t seed, const Grid& grid, const Arena& arena) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    RandomStream random(seed, index, kBoxPlaces, attempt);
    Box box;
    box.length_m = whole_mm(random.uniform(kShortestSide_m, kLongestSide_m));
    box.width_m = whole_mm(random.uniform(kShortestSide_m, kLongestSide_m));
    const double radius_m =
        0.5 * std::sqrt(box.length_m * box.length_m + box.width_m * box.width_m);
    const double most_m = arena.side_m / 2 - radius_m;
    box.pose = {whole_mm(random.uniform(-most_m, most_m)),
                whole_mm(random.uniform(-most_m, most_m)), whole_tenths(random.uniform(-180, 180))};
    const double reach_m = radius_m + kRobotRadius_m + kClearance_m;
    if (grid.is_free(box.pose.x_m, box.pose.y_m, reach_m, arena.robots)) return box;
  }
}

std::vector<Box> make_walls(double side_m) {
  const double length_m = whole_mm(side_m + 2 * kWallThickness_m);
  const double off_m = whole_mm(side_m / 2 + kWallThickness_m / 2);
  return {{length_m, kWallThickness_m, {0, -off_m, 0}},
          {length_m, kWallThickness_m, {0, off_m, 0}},
          {kWallThickness_m, length_m, {-off_m, 0, 0}},
          {kWallThickness_m, length_m, {off_m, 0, 0}}};
}

}  // namespace

Arena make_arena(std::uint32_t robots, std::uint64_t seed) {
  Arena arena;
  // An even number of millimetres, so that half of it is a whole one.
  arena.side_m = 2 * whole_mm(std::sqrt(kAreaPerRobot_m2 * robots) / 2);
  arena.walls = make_walls(arena.side_m);
  const Grid grid(robots, arena.side_m);
  arena.robots.reserve(robots);
  for (std::uint32_t r = 0; r < robots; ++r) arena.robots.push_back(grid.place(r, seed));
  arena.boxes.reserve(robots / 2);
  for (std::uint32_t b = 0; b < robots / 2; ++b) {
    arena.boxes.push_back(make_box(b, seed, grid, arena));
  }
  return arena;
}

}  // namespace rave::swarm
