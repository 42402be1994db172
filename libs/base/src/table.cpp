// SPDX-License-Identifier: Apache-2.0
#include "rave/base/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <utility>

#include "rave/base/text_width.hpp"

namespace rave {
namespace {

constexpr std::string_view kBold = "\033[1m";
constexpr std::string_view kPlain = "\033[0m";
/// Between the columns of a table without rules.
constexpr std::size_t kGap = 2;
/// Before a cell that stands below its row.
constexpr std::size_t kBelowIndent = 6;

/// A column that is shown, and how wide it is.
struct Shown {
  std::size_t index = 0;
  std::size_t width = 0;
};
using Columns = std::vector<Shown>;
using Lines = std::vector<std::string>;  ///< Of one cell.

std::string text_of(const std::vector<TableCell>& row, std::size_t column) {
  return column < row.size() ? without_controls(row[column].text) : std::string();
}

Tone tone_of(const std::vector<TableCell>& row, std::size_t column) {
  return column < row.size() ? row[column].tone : Tone::kPlain;
}

/// The width that a text takes in a column without any other limit.
std::size_t natural_width(const TableColumn& column, std::string_view text) {
  if (column.widest == 0) return columns_of(text);
  std::size_t width = 0;
  for (const std::string& line : wrap_to_columns(text, column.widest)) {
    width = std::max(width, columns_of(line));
  }
  return width;
}

/// All columns but those that may be left out and have no text.
Columns natural_columns(const Table& table) {
  Columns columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const TableColumn& column = table.columns[i];
    std::size_t width = 0;
    for (const auto& row : table.rows) {
      width = std::max(width, natural_width(column, text_of(row, i)));
    }
    if (width == 0 && column.weight != 0) continue;
    const std::string heading = without_controls(column.heading);
    width = std::max({width, natural_width(column, heading), column.least});
    columns.push_back({i, width});
  }
  return columns;
}

/// Breaks a text at spaces; a word that is too long is cut.
Lines wrapped_or_cut(std::string_view text, std::size_t width) {
  Lines lines;
  std::string line;
  while (!text.empty()) {
    const std::size_t space = text.find(' ');
    const std::string_view word = text.substr(0, space);
    text.remove_prefix(space == std::string_view::npos ? text.size() : space + 1);
    if (!line.empty() && columns_of(line) + 1 + columns_of(word) > width) {
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

std::string aligned(const std::string& text, std::size_t width, Align align) {
  const std::size_t room = width - std::min(width, columns_of(text));
  std::size_t before = 0;
  if (align == Align::kRight) before = room;
  if (align == Align::kCentre) before = room / 2;
  return std::string(before, ' ') + text + std::string(room - before, ' ');
}

/// Removes the column with the least weight; false if all that are left have to stay.
bool leave_out_least(const Table& table, Columns& columns) {
  const auto weight = [&](const Shown& column) {
    const int own = table.columns[column.index].weight;
    return own == 0 ? std::numeric_limits<int>::max() : own;
  };
  if (columns.size() < 2) return false;
  const auto least = std::ranges::min_element(columns, {}, weight);
  if (table.columns[least->index].weight == 0) return false;
  columns.erase(least);
  return true;
}

/// A table with rules: too wide, it leaves out columns with a weight, and then the others get
/// narrower.
class RuledTable {
 public:
  RuledTable(const Table& table, const TableOptions& options)
      : table_(table), ansi_(options.ansi), columns_(natural_columns(table)) {
    for (Shown& column : columns_) column.width = std::max<std::size_t>(column.width, 1);
    if (!options.width) return;
    constexpr std::size_t kReadable = 12;
    const auto may_wrap = [this](const Shown& column) {
      return table_.columns[column.index].may_wrap;
    };
    Columns natural = columns_;
    do {
      columns_ = natural;
      shrink(*options.width, kComfortable, may_wrap);
    } while (total() > *options.width && leave_out_least(table_, natural));
    shrink(*options.width, kReadable, may_wrap);
    shrink(*options.width, 1, [](const Shown&) { return true; });
  }

  Lines lines() {
    rule("┌", "┬", "┐");
    std::vector<TableCell> headings;
    for (const TableColumn& column : table_.columns) headings.emplace_back(column.heading);
    row(headings, true);
    rule("├", "┼", "┤");
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      const auto& before = table_.rules_before;
      if (i > 0 && std::find(before.begin(), before.end(), i) != before.end()) rule("├", "┼", "┤");
      row(table_.rows[i], false);
    }
    rule("└", "┴", "┘");
    return std::move(lines_);
  }

 private:
  /// A rule and two blanks per cell, and the last rule.
  [[nodiscard]] std::size_t total() const {
    std::size_t total = 3 * columns_.size() + 1;
    for (const Shown& column : columns_) total += column.width;
    return total;
  }

  /// Reduces the widest column that may shrink, one character at a time, down to `least`.
  template <class May>
  void shrink(std::size_t limit, std::size_t least, May may) {
    while (total() > limit) {
      Shown* widest = nullptr;
      for (Shown& column : columns_) {
        if (!may(column) || column.width <= least) continue;
        if (widest == nullptr || column.width > widest->width) widest = &column;
      }
      if (widest == nullptr) return;
      --widest->width;
    }
  }

  void rule(std::string_view left, std::string_view between, std::string_view right) {
    std::string line(left);
    for (const Shown& column : columns_) {
      if (&column != &columns_.front()) line += between;
      for (std::size_t k = 0; k < column.width + 2; ++k) line += "─";
    }
    line += right;
    lines_.push_back(toned(std::move(line), Tone::kFaint, ansi_));
  }

  [[nodiscard]] std::string cell(const std::string& text, Tone tone, bool is_heading) const {
    if (!is_heading) return toned(text, tone, ansi_);
    return ansi_ ? fmt::format("{}{}{}", kBold, text, kPlain) : text;
  }

  void row(const std::vector<TableCell>& cells, bool is_heading) {
    std::vector<Lines> texts;
    std::size_t height = 1;
    for (const Shown& column : columns_) {
      const std::string text = text_of(cells, column.index);
      const bool wraps = table_.columns[column.index].may_wrap && !is_heading;
      texts.push_back(wraps ? wrapped_or_cut(text, column.width)
                            : Lines{clip_to_columns(text, column.width)});
      height = std::max(height, texts.back().size());
    }
    const std::string bar = toned("│", Tone::kFaint, ansi_);
    for (std::size_t line = 0; line < height; ++line) {
      std::string out = bar;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        const auto& [index, width] = columns_[i];
        const std::string text = line < texts[i].size() ? texts[i][line] : std::string();
        const std::string padded = aligned(text, width, table_.columns[index].align);
        out += fmt::format(" {} {}", cell(padded, tone_of(cells, index), is_heading), bar);
      }
      lines_.push_back(std::move(out));
    }
  }

  const Table& table_;
  bool ansi_;
  Columns columns_;
  Lines lines_;
};

/// A table without rules: too wide, whole columns are left out.
class SpacedTable {
 public:
  SpacedTable(const Table& table, const TableOptions& options)
      : table_(table), options_(options), columns_(natural_columns(table)) {
    if (options.width) fit(*options.width);
  }

  Lines lines() {
    std::vector<TableCell> headings;
    for (const TableColumn& column : table_.columns) {
      headings.emplace_back(column.heading, Tone::kFaint);
    }
    row(headings);
    const std::size_t all = table_.rows.size();
    const std::size_t most = options_.most_rows;
    const std::size_t shown = all <= most ? all : most - std::min<std::size_t>(1, most);
    for (std::size_t i = 0; i < shown; ++i) row(table_.rows[i]);
    if (shown < all) {
      const std::string more = fmt::format("and {} more", all - shown);
      lines_.push_back(options_.width ? clip_to_columns(more, *options_.width) : more);
    }
    return std::move(lines_);
  }

 private:
  [[nodiscard]] std::size_t total() const {
    std::size_t total = options_.indent;
    for (const Shown& column : columns_) {
      total += column.width + (&column == &columns_.front() ? 0 : kGap);
    }
    return total;
  }

  void fit(std::size_t limit) {
    if (!columns_.empty() && table_.columns[columns_.back().index].below != 0) {
      columns_.back().width = 0;
      const std::size_t used = total();
      const std::size_t left = limit - std::min(limit, used);
      below_ = left < table_.columns[columns_.back().index].below;
      if (!below_) columns_.back().width = left;
      return;
    }
    while (total() > limit && leave_out_least(table_, columns_)) {
    }
    if (columns_.size() == 1) columns_.front().width = std::min(columns_.front().width, limit);
  }

  [[nodiscard]] Lines cell_lines(const Shown& column, const std::string& text) const {
    const TableColumn& how = table_.columns[column.index];
    const bool wraps = how.widest != 0 || (how.below != 0 && options_.width);
    return wraps ? wrap_to_columns(text, column.width) : Lines{clip_to_columns(text, column.width)};
  }

  void row(const std::vector<TableCell>& cells) {
    const std::size_t count = columns_.size() - (below_ ? 1 : 0);
    std::vector<Lines> texts;
    std::size_t height = 1;
    for (std::size_t i = 0; i < count; ++i) {
      texts.push_back(cell_lines(columns_[i], text_of(cells, columns_[i].index)));
      height = std::max(height, texts.back().size());
    }
    for (std::size_t line = 0; line < height; ++line) {
      std::string out(options_.indent, ' ');
      for (std::size_t i = 0; i < count; ++i) {
        const auto& [index, width] = columns_[i];
        const std::string text = line < texts[i].size() ? texts[i][line] : std::string();
        const std::string space(width - std::min(width, columns_of(text)), ' ');
        const bool right = table_.columns[index].align == Align::kRight;
        if (i > 0) out.append(kGap, ' ');
        if (right) out += space;
        out += toned(text, tone_of(cells, index), options_.ansi);
        if (!right) out += space;
      }
      out.erase(out.find_last_not_of(' ') + 1);
      lines_.push_back(std::move(out));
    }
    if (below_) add_below(text_of(cells, columns_.back().index));
  }

  void add_below(const std::string& text) {
    for (const std::string& line : wrap_to_columns(text, *options_.width - kBelowIndent)) {
      lines_.push_back(line.empty() ? line : std::string(kBelowIndent, ' ') + line);
    }
  }

  const Table& table_;
  const TableOptions& options_;
  Columns columns_;
  bool below_ = false;  ///< The last column stands below its rows.
  Lines lines_;
};

}  // namespace

std::string toned(std::string text, Tone tone, bool ansi) {
  if (!ansi || tone == Tone::kPlain || text.empty()) return text;
  constexpr std::string_view kToneCodes[] = {"", "2", "32", "33", "1;31"};
  return fmt::format("\033[{}m{}{}", kToneCodes[static_cast<std::size_t>(tone)], text, kPlain);
}

std::vector<std::string> table_lines(const Table& table, const TableOptions& options) {
  std::vector<std::string> lines;
  if (!table.title.empty()) {
    const std::string title = without_controls(table.title);
    lines.push_back(options.ansi ? fmt::format("{}{}{}", kBold, title, kPlain) : title);
  }
  if (table.columns.empty()) return lines;
  const bool rules = options.look == TableLook::kRules;
  for (std::string& line :
       rules ? RuledTable(table, options).lines() : SpacedTable(table, options).lines()) {
    lines.push_back(std::move(line));
  }
  return lines;
}

std::string render_table(const Table& table, const TableOptions& options) {
  std::string text;
  for (const std::string& line : table_lines(table, options)) text += line + "\n";
  return text;
}

}  // namespace rave
