// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rave::report {

enum class Align : std::uint8_t { kLeft, kRight, kCentre };

struct TableColumn {
  std::string heading;
  Align align = Align::kLeft;
  /// If the table is too wide, the cells of this column are wrapped at spaces.
  bool may_wrap = false;
};

/// A table of text. Cells are UTF-8; rows shorter than the columns are filled with empty cells,
/// longer ones are cut.
struct Table {
  std::string title;  ///< Shown above the table; empty for none.
  std::vector<TableColumn> columns;
  std::vector<std::vector<std::string>> rows;
  /// Indices into `rows` before which a horizontal rule is drawn, to group rows.
  std::vector<std::size_t> rules_before;
};

struct TableOptions {
  /// The width of the terminal in columns. The table is not wider if possible (each of its columns
  /// keeps at least one character). Empty: no limit.
  std::optional<std::size_t> width;
  bool ansi = false;  ///< Bold headings and faint rules by escape codes; the caller checks isatty.
};

/// The table as lines, each ending in a newline. Without columns: only the title. Control
/// characters in cells are removed, so that no cell can move the cursor.
[[nodiscard]] std::string render_table(const Table& table, const TableOptions& options = {});

}  // namespace rave::report
