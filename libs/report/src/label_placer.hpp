// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "rave/report/layout.hpp"

namespace rave::report {

/// Finds free places for labels beside the things they name. Greedy: what is placed first gets
/// the best place, so ask in order of importance.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PageBox& area);

  /// No label may cover this.
  void block(const PageBox& box) { blocked_.push_back(box); }
  /// Something that has a label: a label rather is not nearer to this than to its own thing.
  void add_anchor(Vec2 anchor) { anchors_.push_back(anchor); }
  /// Labels rather do not cover this point (of a line, say), a heavier one still less.
  void weigh(Vec2 point, int weight);

  /// A box of the given size beside the anchor, `clearance` away from it or somewhat farther, free
  /// of what is blocked, inside the area, where least is covered; it is blocked from now on.
  /// None if there is no room.
  [[nodiscard]] std::optional<PageBox> place(Vec2 anchor, double width, double height,
                                             double clearance);

 private:
  [[nodiscard]] bool is_free(const PageBox& box) const;
  [[nodiscard]] double weight_under(const PageBox& box) const;
  [[nodiscard]] bool is_nearer_to_another(const PageBox& box, Vec2 own) const;
  [[nodiscard]] std::size_t column_of(double x) const;
  [[nodiscard]] std::size_t row_of(double y) const;

  PageBox area_;
  std::vector<PageBox> blocked_;
  std::vector<Vec2> anchors_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<int> weights_;  ///< The heaviest point of each cell, row by row.
};

}  // namespace rave::report
