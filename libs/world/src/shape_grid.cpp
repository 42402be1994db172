// SPDX-License-Identifier: Apache-2.0
// A uniform grid of pieces, built anew in each step by a counting sort. A piece is in the one cell
// of its centre, so queries look one largest radius farther.
#include "rave/world/shape_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rave::world {
namespace {

/// Limits memory: where things are far apart, cells grow instead.
constexpr double kMaxCells = 1 << 20;
/// Building visits every cell, so few pieces get few cells, however far apart they are. With this
/// number a piece costs at most twice what it costs in a crowd.
constexpr double kCellsPerPiece = 64;
constexpr std::size_t kMaxPieces = 4096;

struct Box {
  Vec2 low;
  Vec2 high;
};

Box box_of(std::span<const Vec2> points) {
  Box box{points.front(), points.front()};
  for (const Vec2 p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}

// Not the smallest disc, but found in one pass; its radius is at most sqrt(2) times the smallest.
CoverDisc disc_of(std::span<const Vec2> points) {
  const Box box = box_of(points);
  CoverDisc disc{0.5 * (box.low + box.high), 0};
  for (const Vec2 p : points) {
    disc.radius_m = std::max(disc.radius_m, std::sqrt(squared_norm(p - disc.centre_B)));
  }
  return disc;
}

/// The part of a convex polygon with n.p <= c (Sutherland and Hodgman, 1974, for one line).
std::vector<Vec2> clip(std::span<const Vec2> polygon, Vec2 n, double c) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    const double da = dot(n, a) - c;
    const double db = dot(n, b) - c;
    if (da <= 0) kept.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + (da / (da - db)) * (b - a));
  }
  return kept;
}

/// Halves a polygon across its longer side until every piece is small enough.
void split(std::vector<Vec2> polygon, double largest_m, std::vector<CoverDisc>& pieces) {
  std::vector<std::vector<Vec2>> waiting;
  waiting.push_back(std::move(polygon));
  while (!waiting.empty()) {
    const std::vector<Vec2> piece = std::move(waiting.back());
    waiting.pop_back();
    const CoverDisc disc = disc_of(piece);
    // A limit on the number, since a wall may be kilometres long.
    if (disc.radius_m <= largest_m || pieces.size() + waiting.size() >= kMaxPieces) {
      pieces.push_back(disc);
      continue;
    }
    const Box box = box_of(piece);
    const bool along_x = box.high.x - box.low.x >= box.high.y - box.low.y;
    const Vec2 n = along_x ? Vec2{1, 0} : Vec2{0, 1};
    const double c = dot(n, disc.centre_B);
    for (const double side : {1.0, -1.0}) {
      std::vector<Vec2> half = clip(piece, side * n, side * c);
      if (half.size() >= 3) waiting.push_back(std::move(half));
    }
  }
}

}  // namespace

std::vector<CoverDisc> cover(const Shape& shape, double largest_m) {
  if (shape.kind == ShapeKind::kDisc) return {{shape.centre, shape.radius_m}};
  std::vector<CoverDisc> pieces;
  const std::span<const Vec2> vertices = shape.vertices();
  split({vertices.begin(), vertices.end()}, largest_m, pieces);
  return pieces;
}

bool ShapeGrid::lay_cells(std::span<const ShapePiece> pieces, double cell_m) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec2 low{kInfinity, kInfinity};
  Vec2 high{-kInfinity, -kInfinity};
  float largest_m = 0;
  double radii_m = 0;
  std::size_t count = 0;
  for (const ShapePiece& piece : pieces) {
    if (piece.pieces == 0) continue;
    low = {std::min(low.x, piece.centre_W.x), std::min(low.y, piece.centre_W.y)};
    high = {std::max(high.x, piece.centre_W.x), std::max(high.y, piece.centre_W.y)};
    largest_m = std::max(largest_m, piece.radius_m);
    radii_m += static_cast<double>(piece.radius_m);
    ++count;
  }
  width_ = 0;
  height_ = 0;
  largest_m_ = static_cast<double>(largest_m);
  mean_radius_m_ = 0;
  pieces_per_m2_ = 0;
  cell_m_ = cell_m;
  if (!(low.x <= high.x)) return false;
  mean_radius_m_ = radii_m / static_cast<double>(count);
  // One metre is added to each extent, because pieces in a row would have no area.
  pieces_per_m2_ = static_cast<double>(count) / ((high.x - low.x + 1) * (high.y - low.y + 1));
  size_ = high - low;
  // The limit of the width and of the height, and about that of their product.
  const double cells = std::min(kMaxCells, kCellsPerPiece * static_cast<double>(count));
  const double cell = std::max(
      {cell_m, size_.x / cells, size_.y / cells, std::sqrt(size_.x * size_.y / cells) + 1e-9});
  origin_ = low;
  cells_per_m_ = 1.0 / cell;
  cell_m_ = cell;
  width_ = static_cast<int>(std::min(size_.x * cells_per_m_, cells)) + 1;
  height_ = static_cast<int>(std::min(size_.y * cells_per_m_, cells)) + 1;
  return true;
}

double ShapeGrid::farthest_m(Vec2 p) const noexcept {
  if (width_ == 0) return 0;
  const Vec2 apart = p - origin_;
  const Vec2 far{std::max(std::abs(apart.x), std::abs(apart.x - size_.x)),
                 std::max(std::abs(apart.y), std::abs(apart.y - size_.y))};
  return std::sqrt(squared_norm(far)) + largest_m_;
}

void ShapeGrid::build(std::span<const ShapePiece> pieces, double cell_m) {
  if (!lay_cells(pieces, cell_m)) {
    sorted_.clear();
    return;
  }
  // A counting sort: count the pieces of each cell, add up, put each at its place. Pieces of a row
  // of cells lie one behind the other, so a query reads whole rows.
  begin_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) + 1, 0);
  slots_.resize(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].pieces == 0) continue;
    const int x = cell_of(pieces[i].centre_W.x - origin_.x, width_);
    const int y = cell_of(pieces[i].centre_W.y - origin_.y, height_);
    const std::uint32_t cell = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
                               static_cast<std::uint32_t>(x);
    slots_[i] = {cell, begin_[cell]++};
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& count : begin_) {
    const std::uint32_t first = sum;
    sum += count;
    count = first;
  }
  // The sort is stable within a cell.
  sorted_.resize(sum);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].pieces == 0) continue;
    sorted_[begin_[slots_[i].cell] + slots_[i].rank] = pieces[i];
  }
  fill_columns();
}

void ShapeGrid::fill_columns() {
  // Up to about 2 km from the origin, rounding to float moves piece and sensor together by less.
  constexpr float kRounding_m = 1e-3F;
  const std::size_t size = sorted_.size() + kPiecePadding;
  x_m_.resize(size);
  y_m_.resize(size);
  reach_m_.resize(size);
  for (std::size_t i = 0; i < sorted_.size(); ++i) {
    const ShapePiece& piece = sorted_[i];
    x_m_[i] = static_cast<float>(piece.centre_W.x - origin_.x);
    y_m_[i] = static_cast<float>(piece.centre_W.y - origin_.y);
    reach_m_[i] = piece.radius_m + kRounding_m;
  }
}

}  // namespace rave::world
