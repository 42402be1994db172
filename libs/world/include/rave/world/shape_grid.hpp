// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rave/math/pose.hpp"
#include "rave/world/body.hpp"
#include "rave/world/layer.hpp"

namespace rave::world {

/// A piece of a shape at its place in the world: the data that a query needs before it reads the
/// shape itself. It is small, so that neighbouring pieces fill few cache lines.
struct ShapePiece {
  Vec2 centre_W;       ///< Centre of a disc that contains the piece; for kDisc of the disc itself.
  float radius_m = 0;  ///< Radius of that disc.
  float z0_m = 0;
  float z1_m = 0;
  std::uint32_t body = 0;
  std::uint32_t shape = 0;
  std::uint32_t first_vertex = 0;
  std::uint8_t vertex_count = 0;  ///< 0: a disc.
  std::uint8_t layer = 0;         ///< The bit of rave::Layer.
  /// Number of pieces of the same shape. More than 1: a query may visit the shape again. 0: the
  /// body is absent, the index omits the piece.
  std::uint16_t pieces = 1;
  std::uint32_t index = 0;  ///< Index of this piece in Snapshot::pieces().

  [[nodiscard]] bool in_layers(LayerMask layers) const noexcept { return (layers & layer) != 0; }
  [[nodiscard]] bool at_height(float z_m) const noexcept { return z_m >= z0_m && z_m <= z1_m; }
};
static_assert(sizeof(ShapePiece) == 48);

/// Number of additional elements after lists of vertices, so that they can be read in groups.
inline constexpr std::size_t kVertexPadding = 3;
/// Number of additional, unreachable pieces after the columns, so that they can be read in groups.
inline constexpr std::size_t kPiecePadding = 16;

/// The positions of pieces as one array per coordinate, relative to `origin`, for vector
/// instructions.
struct PieceColumns {
  const float* x_m = nullptr;
  const float* y_m = nullptr;
  /// Radius of the piece's disc, enlarged by the rounding to float.
  const float* reach_m = nullptr;
  Vec2 origin;  ///< Origin of x_m and y_m, in W.
};

/// The range [begin, end) of consecutive pieces.
struct PieceRow {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A rectangle of grid cells, both corners included; empty if y1 < y0.
struct CellBlock {
  int x0 = 0;
  int x1 = -1;
  int y0 = 0;
  int y1 = -1;
};

/// A uniform grid over pieces. Each piece is in the cell of its centre (counting sort). Build it,
/// then query it from any number of threads. Rebuilding does not allocate unless there are more
/// pieces or a larger area than before.
class ShapeGrid {
 public:
  /// Cells are `cell_m` wide, or wider if the extent would need more than about 64 cells for each
  /// piece or 2^20 in all.
  void build(std::span<const ShapePiece> pieces, double cell_m);

  /// The cells with pieces that may come within `radius_m` of `p`.
  [[nodiscard]] CellBlock cells_near(Vec2 p, double radius_m) const noexcept {
    if (width_ == 0) return {};
    const double reach_m = radius_m + largest_m_;
    return {cell_of(p.x - reach_m - origin_.x, width_), cell_of(p.x + reach_m - origin_.x, width_),
            cell_of(p.y - reach_m - origin_.y, height_),
            cell_of(p.y + reach_m - origin_.y, height_)};
  }
  /// The pieces in row y of a block, y0 <= y <= y1.
  [[nodiscard]] PieceRow row_of(const CellBlock& block, int y) const noexcept {
    const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    return {begin_[row + static_cast<std::size_t>(block.x0)],
            begin_[row + static_cast<std::size_t>(block.x1) + 1]};
  }
  [[nodiscard]] std::size_t size() const noexcept { return sorted_.size(); }
  [[nodiscard]] PieceColumns columns() const noexcept {
    return {x_m_.data(), y_m_.data(), reach_m_.data(), origin_};
  }
  [[nodiscard]] const ShapePiece& piece(std::uint32_t index) const noexcept {
    return sorted_[index];
  }

  /// Calls `visit(piece)` for each piece whose disc comes within `radius_m` of `p`, row by row.
  template <class Visit>
  void for_each_near(Vec2 p, double radius_m, Visit&& visit) const {
    const CellBlock block = cells_near(p, radius_m);
    for (int y = block.y0; y <= block.y1; ++y) {
      const PieceRow row = row_of(block, y);
      for (std::uint32_t i = row.begin; i < row.end; ++i) {
        const ShapePiece& piece = sorted_[i];
        const double dx = piece.centre_W.x - p.x;
        const double dy = piece.centre_W.y - p.y;
        const double reach = radius_m + static_cast<double>(piece.radius_m);
        if (dx * dx + dy * dy <= reach * reach) visit(piece);
      }
    }
  }

  /// Calls `visit(piece)` for each piece whose disc comes within `width_m` of the segment of the
  /// ray from p along the unit vector `direction` between `from_m` and `to_m`. It walks the cells
  /// beside the segment row by row, as J. Amanatides and A. Woo (Eurographics 1987), but for a ray
  /// with a width, because a piece is only in the cell of its centre.
  template <class Visit>
  void for_each_along(Vec2 p, Vec2 direction, double from_m, double to_m, double width_m,
                      Visit&& visit) const {
    if (width_ == 0) return;
    const double reach_m = largest_m_ + width_m;
    const Vec2 a = p + from_m * direction - origin_;
    const Vec2 b = p + to_m * direction - origin_;
    const double per_m = 1 / (b.y - a.y);  // used only if the segment crosses rows
    const int last_row = cell_of(std::max(a.y, b.y) + reach_m, height_);
    for (int y = cell_of(std::min(a.y, b.y) - reach_m, height_); y <= last_row; ++y) {
      const Span part = part_beside_row(a.y, b.y, per_m, y, reach_m);
      if (!(part.first <= part.last)) continue;
      const double x_m[2] = {a.x + part.first * (b.x - a.x), a.x + part.last * (b.x - a.x)};
      const CellBlock cells{cell_of(std::min(x_m[0], x_m[1]) - reach_m, width_),
                            cell_of(std::max(x_m[0], x_m[1]) + reach_m, width_), y, y};
      const PieceRow row = row_of(cells, y);
      for (std::uint32_t i = row.begin; i < row.end; ++i) {
        const ShapePiece& piece = sorted_[i];
        const Vec2 apart = piece.centre_W - p;
        const double own_m = static_cast<double>(piece.radius_m) + width_m;
        const double along_m = dot(apart, direction);
        const bool beside = std::abs(cross(direction, apart)) <= own_m;
        if (beside && along_m >= from_m - own_m && along_m <= to_m + own_m) visit(piece);
      }
    }
  }
  /// An upper bound of the distance from p to any piece; 0 if there are none.
  [[nodiscard]] double farthest_m(Vec2 p) const noexcept;
  /// Number of pieces per square metre, and their mean radius.
  [[nodiscard]] double pieces_per_m2() const noexcept { return pieces_per_m2_; }
  [[nodiscard]] double mean_radius_m() const noexcept { return mean_radius_m_; }
  [[nodiscard]] double largest_radius_m() const noexcept { return largest_m_; }
  [[nodiscard]] double cell_m() const noexcept { return cell_m_; }
  [[nodiscard]] int rows() const noexcept { return height_; }

 private:
  /// A part of a segment as fractions of its length, each 0 to 1; empty if first > last.
  struct Span {
    double first = 0;
    double last = 1;
  };
  /// The part of a segment between two heights above the origin that pieces with their centre in
  /// row y can touch. `per_m`: 1 / (to - from).
  [[nodiscard]] Span part_beside_row(double from_m, double to_m, double per_m, int y,
                                     double reach_m) const noexcept {
    // A segment along the row: all of it.
    if (std::abs(to_m - from_m) <= reach_m) return {};
    const double low_m = y * cell_m_ - reach_m - from_m;
    // The last row also contains everything beyond it.
    const double high_m = y + 1 == height_ ? std::numeric_limits<double>::infinity()
                                           : (y + 1) * cell_m_ + reach_m - from_m;
    const double first = low_m * per_m;
    const double last = high_m * per_m;
    return {std::clamp(std::min(first, last), 0.0, 1.0),
            std::clamp(std::max(first, last), 0.0, 1.0)};
  }

  void fill_columns();
  /// Target of a piece in the sort: its cell, and its rank within that cell.
  struct Slot {
    std::uint32_t cell = 0;
    std::uint32_t rank = 0;
  };

  /// Chooses origin, size and number of cells; false if there are no pieces.
  bool lay_cells(std::span<const ShapePiece> pieces, double cell_m);
  [[nodiscard]] int cell_of(double offset_m, int count) const noexcept {
    const double cell = offset_m * cells_per_m_;
    if (!(cell > 0)) return 0;
    return cell >= count ? count - 1 : static_cast<int>(cell);
  }

  Vec2 origin_;
  Vec2 size_;  ///< Extent from the origin to the last centre.
  double cells_per_m_ = 1;
  double cell_m_ = 1;
  double largest_m_ = 0;
  double mean_radius_m_ = 0;
  double pieces_per_m2_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint32_t> begin_;  ///< Per cell; one more at the end.
  std::vector<Slot> slots_;           ///< Per piece, used while building.
  std::vector<ShapePiece> sorted_;
  std::vector<float> x_m_;  ///< Positions of sorted_, relative to origin_; these three are padded.
  std::vector<float> y_m_;
  std::vector<float> reach_m_;
};

/// A disc of a cover, in the frame of the shape's body.
struct CoverDisc {
  Vec2 centre_B;
  double radius_m = 0;
};

/// Discs of at most about `largest_m` radius that together cover the shape. A long wall is covered
/// by several, so that a query near one end does not find its other end. At most 4096 discs; larger
/// ones if that is not enough. A disc is its own cover.
[[nodiscard]] std::vector<CoverDisc> cover(const Shape& shape, double largest_m);

}  // namespace rave::world
