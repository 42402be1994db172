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

/// What to do with a malformed row within a log.
enum class BadRowPolicy : std::uint8_t {
  kRefuse,  ///< Error with file, line and column.
  kSkip,    ///< Skip the row and report it.
};

struct ParsePolicy {
  BadRowPolicy bad_rows = BadRowPolicy::kRefuse;
  /// Keep the complete lines of a log with a truncated last line.
  bool accept_cut = false;
};

struct ParsedLog {
  std::vector<LogRow> rows;  ///< In file order.
  std::vector<Repair> repairs;
};

/// Parses rows of numbers separated by blanks; `#` starts a comment line, blank lines are skipped.
/// A last line without newline counts as truncated if columns are missing, if its last value is
/// invalid or has fewer decimals than in the row before, or if the gzip stream is truncated. Errors
/// (kParse, with `file`, line, column): a wrong number of columns, an invalid value, NaN or
/// infinity, a truncated log unless the policy accepts it.
[[nodiscard]] Result<ParsedLog> parse_log(const UnpackedText& log, const std::string& file,
                                          std::span<const Column> columns,
                                          const ParsePolicy& policy);

}  // namespace rave::utias
