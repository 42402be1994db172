// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rave {

/// The width below which a wrapped sentence is hard to read.
inline constexpr std::size_t kComfortable = 40;

/// The alignment of the text of a cell in its column.
enum class Align : std::uint8_t { kLeft, kRight, kCentre };

/// The meaning of a text for the reader; determines its colour on a terminal.
enum class Tone : std::uint8_t { kPlain, kFaint, kGood, kCare, kBad };

/// A cell of a table, in UTF-8. Control characters are removed when it is shown, so that no cell
/// can move the cursor.
struct TableCell {
  TableCell() = default;
  TableCell(std::string of, Tone how = Tone::kPlain) : text(std::move(of)), tone(how) {}
  TableCell(const char* of) : text(of) {}

  std::string text;
  Tone tone = Tone::kPlain;
};

/// How a column of a table is headed and how wide it may be.
struct TableColumn {
  std::string heading{};
  Align align = Align::kLeft;
  /// If the table is too wide, the cells of this column are wrapped at spaces.
  bool may_wrap = false;
  /// 0: the column always appears. Columns with a weight are left out if they have no text, or if
  /// the table is too wide, the least weight first. A table with rules leaves them out before it
  /// wraps a column to less than `kComfortable` characters.
  int weight = 0;
  /// Longer cells continue in the next line, also without a limit of the table; 0: no limit.
  std::size_t widest = 0;
  std::size_t least = 0;  ///< Narrower columns are filled up to this width.
  /// Not 0, of the last column alone: it takes the width that is left, and with less than this its
  /// cells stand below their rows.
  std::size_t below = 0;
};

/// A table of text. Rows shorter than the columns are filled with empty cells, longer ones are cut.
struct Table {
  std::string title;  ///< Shown above the table; empty for none.
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows;
  /// Indices into `rows` before which a horizontal rule is drawn, to group rows. Of a table with
  /// rules alone.
  std::vector<std::size_t> rules_before;
};

/// How columns are kept apart.
enum class TableLook : std::uint8_t {
  kRules,   ///< Rules around and between the columns; bold headings.
  kSpaces,  ///< Two spaces between the columns, none at the ends of lines; faint headings.
};

/// How a table is shown.
struct TableOptions {
  /// The width of the terminal in columns. The table is not wider if possible (each of its columns
  /// keeps at least one character). Empty: no limit.
  std::optional<std::size_t> width{};
  bool ansi = false;  ///< Colours by escape codes; the caller checks isatty.
  TableLook look = TableLook::kRules;
  std::size_t indent = 0;  ///< Spaces before each line of a table without rules.
  /// Of a table without rules: further rows are counted in one line.
  std::size_t most_rows = std::numeric_limits<std::size_t>::max();
};

/// The table as lines without newlines. Without columns: only the title.
[[nodiscard]] std::vector<std::string> table_lines(const Table& table,
                                                   const TableOptions& options = {});
/// The same as text; each line ends in a newline.
[[nodiscard]] std::string render_table(const Table& table, const TableOptions& options = {});

/// Text in the colour of a tone, by escape codes if `ansi`.
[[nodiscard]] std::string toned(std::string text, Tone tone, bool ansi);

}  // namespace rave
