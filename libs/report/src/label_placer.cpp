// SPDX-License-Identifier: Apache-2.0
// Places labels beside what they name, without overlaps.
#include "label_placer.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace rave::report {
namespace {

constexpr double kCell = 3;
constexpr double kDiagonal = 0.70710678118654752;
/// In the usual order of maps: right first, then left, above, below.
constexpr std::array<Vec2, 8> kDirections = {
    Vec2{1, 0},  Vec2{kDiagonal, -kDiagonal},  Vec2{-1, 0}, Vec2{kDiagonal, kDiagonal},
    Vec2{0, -1}, Vec2{-kDiagonal, -kDiagonal}, Vec2{0, 1},  Vec2{-kDiagonal, kDiagonal}};
/// The cost of a place nearer to another labelled object.
constexpr double kMisleading = 20;
/// The cost of each point before one: the label of a wall is best at its middle.
constexpr double kPerPoint = 0.1;
constexpr std::array<double, 4> kFarther = {0, 4, 9, 15};

Vec2 nearest_in(const PageBox& box, Vec2 p) {
  return {std::clamp(p.x, box.x0, box.x1), std::clamp(p.y, box.y0, box.y1)};
}

std::size_t cell_of(double from_edge, std::size_t count) {
  const double cell = std::clamp(from_edge / kCell, 0.0, static_cast<double>(count - 1));
  return static_cast<std::size_t>(cell);
}

/// The box that touches the point at `distance` from the anchor in this direction.
PageBox box_beside(Vec2 anchor, Vec2 direction, double distance, double width, double height) {
  const Vec2 near = anchor + distance * direction;
  const double centre_x = near.x + 0.5 * width * std::clamp(direction.x * 1.5, -1.0, 1.0);
  const double centre_y = near.y + 0.5 * height * std::clamp(direction.y * 1.5, -1.0, 1.0);
  return {centre_x - 0.5 * width, centre_y - 0.5 * height, centre_x + 0.5 * width,
          centre_y + 0.5 * height};
}

}  // namespace

LabelPlacer::LabelPlacer(const PageBox& area)
    : area_(area),
      columns_(static_cast<std::size_t>(std::max(area.width(), 0.0) / kCell) + 1),
      rows_(static_cast<std::size_t>(std::max(area.height(), 0.0) / kCell) + 1),
      weights_(columns_ * rows_, 0) {}

std::size_t LabelPlacer::column_of(double x) const { return cell_of(x - area_.x0, columns_); }
std::size_t LabelPlacer::row_of(double y) const { return cell_of(y - area_.y0, rows_); }

void LabelPlacer::weigh(Vec2 point, int weight) {
  if (!area_.contains(point)) return;
  int& cell = weights_[row_of(point.y) * columns_ + column_of(point.x)];
  cell = std::max(cell, weight);
}

bool LabelPlacer::is_free(const PageBox& box) const {
  if (box.x0 < area_.x0 || box.x1 > area_.x1 || box.y0 < area_.y0 || box.y1 > area_.y1)
    return false;
  return std::none_of(blocked_.begin(), blocked_.end(),
                      [&](const PageBox& other) { return box.overlaps(other); });
}

double LabelPlacer::weight_under(const PageBox& box) const {
  double weight = 0;
  for (std::size_t row = row_of(box.y0); row <= row_of(box.y1); ++row) {
    for (std::size_t column = column_of(box.x0); column <= column_of(box.x1); ++column) {
      weight += weights_[row * columns_ + column];
    }
  }
  return weight;
}

bool LabelPlacer::is_nearer_to_another(const PageBox& box, std::span<const Vec2> own) const {
  const auto squared_distance = [&](std::span<const Vec2> points) {
    double least = std::numeric_limits<double>::max();
    for (const Vec2 p : points) least = std::min(least, squared_norm(p - nearest_in(box, p)));
    return least;
  };
  const double own_distance = squared_distance(own);
  return std::any_of(objects_.begin(), objects_.end(), [&](const std::vector<Vec2>& other) {
    return !std::ranges::equal(other, own) && squared_distance(other) < own_distance;
  });
}

std::optional<PageBox> LabelPlacer::place(std::span<const Vec2> points, double width, double height,
                                          double clearance) {
  std::optional<PageBox> best;
  double best_cost = 0;
  // Greedy: each label takes the cheapest of 32 places beside each point and blocks it for those
  // after it. A place costs what it covers, its distance, an unusual direction, and how far its
  // point is from the first one.
  for (std::size_t k = 0; k < points.size(); ++k) {
    // A part that is not shown needs no name.
    if (!area_.contains(points[k])) continue;
    for (const double farther : kFarther) {
      for (std::size_t i = 0; i < kDirections.size(); ++i) {
        const PageBox box =
            box_beside(points[k], kDirections[i], clearance + farther, width, height);
        double cost = weight_under(box) + 0.4 * farther + 0.15 * static_cast<double>(i) +
                      kPerPoint * static_cast<double>(k);
        // The cheap tests first: most places lose by their cost alone.
        if ((best && cost >= best_cost) || !is_free(box)) continue;
        if (is_nearer_to_another(box, points)) cost += kMisleading;
        if (best && cost >= best_cost) continue;
        best = box;
        best_cost = cost;
      }
    }
  }
  if (best) block(*best);
  return best;
}

}  // namespace rave::report
