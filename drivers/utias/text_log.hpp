// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "utias/recording_names.hpp"
#include "utias/stream_report.hpp"

namespace rave::utias {

/// The type of a column, and the member of LogRow that receives its value.
enum class ColumnKind : std::uint8_t {
  kStamp,        ///< Seconds with up to nine decimals -> `stamp_ns`.
  kCode,         ///< Whole number from 0 to 1 000 000 -> next of `codes`.
  kReal,         ///< Finite, within +-1e6 -> next of `reals`.
  kNonNegative,  ///< Like kReal, but not below 0.
};

struct Column {
  std::string_view name;  ///< Includes its unit; for messages.
  ColumnKind kind = ColumnKind::kReal;
};

struct LogRow {
  int line = 0;  ///< From 1, comment lines included.
  std::int64_t stamp_ns = 0;
  std::array<int, 2> codes{};
  std::array<double, 4> reals{};
};

struct ParsedLog {
  std::vector<LogRow> rows;  ///< In file order.
  std::vector<Repair> repairs;
};

/// Parses rows of numbers separated by blanks; `#` starts a comment line, blank lines are skipped.
/// A last line without newline counts as truncated if columns are missing, if its last value is
/// invalid or has fewer decimals than in the row before, or if the gzip stream is truncated. Errors
/// (kParse, with `file`, line, column): a wrong number of columns, an invalid value, NaN or
/// infinity, a truncated log. `accept_cut`: keep the complete lines of a truncated log instead.
[[nodiscard]] Result<ParsedLog> parse_log(const UnpackedText& log, const std::string& file,
                                          std::span<const Column> columns, bool accept_cut);

}  // namespace rave::utias
