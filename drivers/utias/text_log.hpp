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

/// What a column of a log holds, and so where its value goes in a LogRow.
enum class ColumnKind : std::uint8_t {
  kStamp,        ///< Seconds with up to nine decimals -> `stamp_ns`.
  kCode,         ///< Whole number from 0 to 1 000 000 -> next of `codes`.
  kReal,         ///< Finite, within +-1e6 -> next of `reals`.
  kNonNegative,  ///< The same, not below 0.
};

struct Column {
  std::string_view name;  ///< With its unit, for messages.
  ColumnKind kind = ColumnKind::kReal;
};

struct LogRow {
  int line = 0;  ///< From 1, comments counted.
  std::int64_t stamp_ns = 0;
  std::array<int, 2> codes{};
  std::array<double, 4> reals{};
};

/// What to do with a row in the middle of a log that does not follow the format.
enum class BadRowPolicy : std::uint8_t {
  kRefuse,  ///< An error that names file, line and column.
  kSkip,    ///< Leave the row out and report it.
};

struct ParsePolicy {
  BadRowPolicy bad_rows = BadRowPolicy::kRefuse;
  /// Keep the whole lines of a log that ends in the middle of one.
  bool accept_cut = false;
};

struct ParsedLog {
  std::vector<LogRow> rows;  ///< In the order of the file.
  std::vector<Repair> repairs;
};

/// Rows of numbers apart by blanks; `#` starts a comment line, blank lines are passed over. A last
/// line without newline counts as cut if columns are missing, if its last value cannot be read or
/// has fewer decimals than the row before, or if the gzip stream broke off.
/// Errors (kParse, with `file`, line, column): wrong number of columns, a value that is not what
/// its column holds, NaN or infinity, a cut log unless the policy accepts it.
[[nodiscard]] Result<ParsedLog> parse_log(const UnpackedText& log, const std::string& file,
                                          std::span<const Column> columns,
                                          const ParsePolicy& policy);

}  // namespace rave::utias
