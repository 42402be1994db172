// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rave/report/layout.hpp"

namespace rave::report {

/// Finds free places for labels beside their objects. Greedy: the first label gets the best place,
/// so place labels in order of importance.
class LabelPlacer {
 public:
  explicit LabelPlacer(const PageBox& area);

  /// Labels never cover this box.
  void block(const PageBox& box) { blocked_.push_back(box); }
  /// Adds a labelled object by points on its middle line: labels avoid places nearer to it than to
  /// their own object. One point stands for a round object.
  void add_object(std::vector<Vec2> points) { objects_.push_back(std::move(points)); }
  /// Labels avoid covering this point (of a line, for example), a larger weight more.
  void weigh(Vec2 point, int weight);

  /// A box of the given size beside one of the points of an object, the best first, at `clearance`
  /// or somewhat farther: not blocked, inside the area, with the least weight covered. It is
  /// blocked from then on. Empty if there is no room or no point is in the area.
  [[nodiscard]] std::optional<PageBox> place(std::span<const Vec2> points, double width,
                                             double height, double clearance);
  [[nodiscard]] std::optional<PageBox> place(Vec2 point, double width, double height,
                                             double clearance) {
    return place({&point, 1}, width, height, clearance);
  }

 private:
  [[nodiscard]] bool is_free(const PageBox& box) const;
  [[nodiscard]] double weight_under(const PageBox& box) const;
  [[nodiscard]] bool is_nearer_to_another(const PageBox& box, std::span<const Vec2> own) const;
  [[nodiscard]] std::size_t column_of(double x) const;
  [[nodiscard]] std::size_t row_of(double y) const;

  PageBox area_;
  std::vector<PageBox> blocked_;
  std::vector<std::vector<Vec2>> objects_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<int> weights_;  ///< The largest weight of each cell, row by row.
};

}  // namespace rave::report
