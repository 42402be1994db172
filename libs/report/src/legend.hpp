// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pen.hpp"

namespace rave::report {

struct LegendEntry {
  /// Draws the symbol into the box, which is kSymbolWidth wide.
  std::function<void(Pen&, const PageBox&)> draw;
  std::string text;
};

struct LegendGroup {
  std::string heading;
  std::vector<LegendEntry> entries;
};

inline constexpr double kSymbolWidth = 26;

/// One line for each kind of object that occurs in the picture.
[[nodiscard]] std::vector<LegendGroup> legend_of(const Picture& picture);
/// The height of the groups in columns.
[[nodiscard]] double height_of(const std::vector<LegendGroup>& groups);
void draw_legend(Pen& pen, const std::vector<LegendGroup>& groups, const PageBox& box);

}  // namespace rave::report
