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
  /// Gives way first, by wrapping its cells at spaces, when the table is too wide.
  bool may_wrap = false;
};

/// A table of text. Cells are UTF-8; rows shorter than the columns are filled with empty cells,
/// longer ones are cut.
struct Table {
  std::string title;  ///< Above the table; empty for none.
  std::vector<TableColumn> columns;
  std::vector<std::vector<std::string>> rows;
  /// Rows before which a rule is drawn, to group them; each an index into `rows`.
  std::vector<std::size_t> rules_before;
};

struct TableOptions {
  /// Columns of the terminal; the table is never wider, if it can be helped (each of its columns
  /// keeps at least one). None: as wide as the cells are.
  std::optional<std::size_t> width;
  bool ansi = false;  ///< Bold headings and faint rules by escape codes; the caller asks isatty.
};

/// The table as lines, each with a newline at its end. No columns: only the title. Control
/// characters in cells are dropped, so that no cell can move the cursor.
[[nodiscard]] std::string render_table(const Table& table, const TableOptions& options = {});

}  // namespace rave::report
