// SPDX-License-Identifier: Apache-2.0
// Tables for terminals.
#include "rave/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "text_width.hpp"

namespace rave::report {
namespace {

constexpr std::string_view kBold = "\033[1m";
constexpr std::string_view kFaint = "\033[2m";
constexpr std::string_view kPlain = "\033[0m";

using Widths = std::vector<std::size_t>;
using Cell = std::vector<std::string>;  ///< Its lines.

/// The total width: a rule and two blanks per cell, and the last rule.
std::size_t total_of(const Widths& widths) {
  return std::accumulate(widths.begin(), widths.end(), 3 * widths.size() + 1);
}

std::string cell_of(const std::vector<std::string>& row, std::size_t column) {
  return column < row.size() ? without_controls(row[column]) : std::string();
}

Widths natural_widths(const Table& table) {
  Widths widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t width = columns_of(without_controls(table.columns[i].heading));
    for (const auto& row : table.rows) width = std::max(width, columns_of(cell_of(row, i)));
    widths.push_back(std::max<std::size_t>(width, 1));
  }
  return widths;
}

/// Reduces the widest column that may shrink, one character at a time, down to `least`.
void shrink(Widths& widths, const std::vector<bool>& may, std::size_t limit, std::size_t least) {
  while (total_of(widths) > limit) {
    std::size_t widest = widths.size();
    for (std::size_t i = 0; i < widths.size(); ++i) {
      if (!may[i] || widths[i] <= least) continue;
      if (widest == widths.size() || widths[i] > widths[widest]) widest = i;
    }
    if (widest == widths.size()) return;
    --widths[widest];
  }
}

Widths widths_of(const Table& table, const std::optional<std::size_t>& limit) {
  Widths widths = natural_widths(table);
  if (!limit) return widths;
  std::vector<bool> may_wrap;
  for (const TableColumn& column : table.columns) may_wrap.push_back(column.may_wrap);
  constexpr std::size_t kReadable = 12;
  // First the columns whose text may wrap, down to a readable width; if that is not enough, all of
  // them.
  shrink(widths, may_wrap, *limit, kReadable);
  shrink(widths, std::vector<bool>(widths.size(), true), *limit, 1);
  return widths;
}

Cell wrapped(std::string_view text, std::size_t width) {
  Cell lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(space == std::string_view::npos ? text.size() : space + 1);
    if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width) {
      // A word alone may be wider than the column.
      lines.push_back(clip_to_columns(line, width));
      line = word;
    } else {
      line += line.empty() ? "" : " ";
      line += word;
    }
  }
  lines.push_back(clip_to_columns(line, width));
  return lines;
}

// Widths in columns of the terminal, not in bytes: fmt would count neither wide nor combining
// characters.
std::string aligned(const std::string& text, std::size_t width, Align align) {
  const std::size_t room = width - std::min(width, columns_of(text));
  std::size_t before = 0;
  if (align == Align::kRight) before = room;
  if (align == Align::kCentre) before = room / 2;
  return std::string(before, ' ') + text + std::string(room - before, ' ');
}

class Renderer {
 public:
  Renderer(const Table& table, const TableOptions& options)
      : table_(table), ansi_(options.ansi), widths_(widths_of(table, options.width)) {}

  std::string run() {
    if (!table_.title.empty()) {
      out_ += styled(without_controls(table_.title), kBold) + "\n";
    }
    if (table_.columns.empty()) return out_;
    rule("┌", "┬", "┐");
    std::vector<std::string> headings;
    for (const TableColumn& column : table_.columns) headings.push_back(column.heading);
    row(headings, true);
    rule("├", "┼", "┤");
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      const auto& before = table_.rules_before;
      if (i > 0 && std::find(before.begin(), before.end(), i) != before.end()) rule("├", "┼", "┤");
      row(table_.rows[i], false);
    }
    rule("└", "┴", "┘");
    return out_;
  }

 private:
  [[nodiscard]] std::string styled(std::string_view text, std::string_view code) const {
    return ansi_ ? fmt::format("{}{}{}", code, text, kPlain) : std::string(text);
  }

  void rule(std::string_view left, std::string_view between, std::string_view right) {
    std::string line(left);
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      if (i > 0) line += between;
      for (std::size_t k = 0; k < widths_[i] + 2; ++k) line += "─";
    }
    line += right;
    out_ += styled(line, kFaint) + "\n";
  }

  void row(const std::vector<std::string>& texts, bool is_heading) {
    std::vector<Cell> cells;
    std::size_t height = 1;
    for (std::size_t i = 0; i < widths_.size(); ++i) {
      const std::string text = cell_of(texts, i);
      const bool wraps = table_.columns[i].may_wrap && !is_heading;
      cells.push_back(wraps ? wrapped(text, widths_[i]) : Cell{clip_to_columns(text, widths_[i])});
      height = std::max(height, cells.back().size());
    }
    const std::string bar = styled("│", kFaint);
    for (std::size_t line = 0; line < height; ++line) {
      out_ += bar;
      for (std::size_t i = 0; i < widths_.size(); ++i) {
        const std::string text = line < cells[i].size() ? cells[i][line] : std::string();
        const std::string cell = aligned(text, widths_[i], table_.columns[i].align);
        out_ += fmt::format(" {} {}", is_heading ? styled(cell, kBold) : cell, bar);
      }
      out_ += "\n";
    }
  }

  const Table& table_;
  bool ansi_;
  Widths widths_;
  std::string out_;
};

}  // namespace

std::string render_table(const Table& table, const TableOptions& options) {
  return Renderer(table, options).run();
}

}  // namespace rave::report
