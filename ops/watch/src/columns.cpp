// SPDX-License-Identifier: Apache-2.0
#include "columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "short_text.hpp"

namespace rave::watch {
namespace {

constexpr std::size_t kBetween = 2;

/// A column that is shown, and how wide it is.
struct Shown {
  std::size_t index;
  std::size_t width;
};

std::vector<Shown> shown_of(const Grid& grid) {
  std::vector<Shown> shown;
  for (std::size_t c = 0; c < grid.columns.size(); ++c) {
    std::size_t width = 0;
    for (const auto& row : grid.rows) width = std::max(width, columns_of(row[c].text));
    // A column without any value is not shown, such as clock offsets in lock-step.
    if (width == 0) continue;
    shown.push_back({c, std::max(width, columns_of(grid.columns[c].heading))});
  }
  return shown;
}

std::size_t width_of(const std::vector<Shown>& shown) {
  std::size_t width = 0;
  for (const Shown& column : shown) width += column.width + kBetween;
  return width < kBetween ? 0 : width - kBetween;
}

void make_fit(const Grid& grid, std::vector<Shown>& shown, std::size_t width) {
  // The least important column goes first, until the rest fits the terminal.
  while (shown.size() > 1 && width_of(shown) > width) {
    shown.erase(std::ranges::min_element(
        shown, {}, [&](const Shown& column) { return grid.columns[column.index].weight; }));
  }
  if (shown.size() == 1) shown.front().width = std::min(shown.front().width, width);
}

template <class TextOf>
std::string line_of(const Grid& grid, const std::vector<Shown>& shown, TextOf text_of,
                    bool colour) {
  std::string line;
  for (const Shown& column : shown) {
    const Cell cell = text_of(column.index);
    const std::string text = fitted(cell.text, column.width);
    const std::string space(column.width - std::min(column.width, columns_of(text)), ' ');
    if (!line.empty()) line.append(kBetween, ' ');
    const bool right = grid.columns[column.index].right;
    const bool last = &column == &shown.back();
    if (right) line += space;
    line += toned(text, cell.tone, colour);
    if (!right && !last) line += space;
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::string toned(std::string text, Tone tone, bool colour) {
  if (!colour || tone == Tone::kPlain || text.empty()) return text;
  constexpr std::string_view kCodes[] = {"", "2", "32", "33", "1;31"};
  return fmt::format("\x1b[{}m{}\x1b[0m", kCodes[static_cast<std::size_t>(tone)], text);
}

std::vector<std::string> lines_of(const Grid& grid, std::size_t width, std::size_t most_rows,
                                  bool colour) {
  std::vector<Shown> shown = shown_of(grid);
  make_fit(grid, shown, width);
  std::vector<std::string> lines;
  lines.push_back(line_of(
      grid, shown,
      [&](std::size_t c) {
        return Cell{grid.columns[c].heading, Tone::kFaint};
      },
      colour));
  const bool all = grid.rows.size() <= most_rows;
  const std::size_t rows = all ? grid.rows.size() : most_rows - std::min<std::size_t>(1, most_rows);
  for (std::size_t r = 0; r < rows; ++r) {
    lines.push_back(line_of(
        grid, shown, [&](std::size_t c) { return grid.rows[r][c]; }, colour));
  }
  if (!all) {
    lines.push_back(fitted(fmt::format("and {} more", grid.rows.size() - rows), width));
  }
  return lines;
}

}  // namespace rave::watch
