// SPDX-License-Identifier: Apache-2.0
#include "utias/text_log.hpp"

#include <cmath>
#include <optional>

#include "recording/tokens.hpp"
#include "utias/recording_names.hpp"

namespace rave::utias {
namespace {

using recording::parse_number;
using recording::shown;
using recording::split;
using recording::Token;

constexpr double kLargestReal = 1e6;
constexpr int kLargestCode = 1'000'000;

/// Why a row was refused.
/// A row with a NaN or an infinity is distinguished from one that cannot be read, because a
/// recording may have either and they have different causes.
struct Fault {
  bool non_finite = false;
  int column = 0;
  std::string message;
};

// A last line without a newline counts as complete if its last word has as many decimals as that of
// the row before.
std::size_t decimals(std::string_view number) noexcept {
  const std::size_t point = number.find('.');
  return point == std::string_view::npos ? 0 : number.size() - point - 1;
}

bool is_non_finite(std::string_view text) noexcept {
  const auto value = parse_number<double>(text);
  return value && !std::isfinite(*value);
}

std::string_view expectation(ColumnKind kind) noexcept {
  switch (kind) {
    case ColumnKind::kStamp:
      return "seconds with at most nine decimals";
    case ColumnKind::kCode:
      return "a whole number from 0 to 1000000";
    case ColumnKind::kReal:
      return "a finite number within +-1e6";
    case ColumnKind::kNonNegative:
      return "a finite number from 0 to 1e6";
  }
  return "a number";
}

/// Converts the values of a row one by one.
class RowReader {
 public:
  explicit RowReader(std::span<const Column> columns) noexcept : columns_(columns) {}

  [[nodiscard]] std::size_t column_count() const noexcept { return columns_.size(); }

  /// The row, or its first error.
  [[nodiscard]] tl::expected<LogRow, Fault> read(std::span<const Token> tokens,
                                                 std::size_t line_length, int line) const {
    if (tokens.size() != columns_.size()) return tl::unexpected(wrong_count(tokens, line_length));
    LogRow row;
    row.line = line;
    std::size_t codes = 0;
    std::size_t reals = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      if (!store(tokens[i].text, columns_[i].kind, row, codes, reals)) {
        return tl::unexpected(wrong_value(tokens[i], columns_[i]));
      }
    }
    return row;
  }

 private:
  static bool store(std::string_view text, ColumnKind kind, LogRow& row, std::size_t& codes,
                    std::size_t& reals) noexcept {
    if (kind == ColumnKind::kStamp) {
      const auto stamp = parse_stamp_ns(text);
      if (stamp) row.stamp_ns = *stamp;
      return stamp.has_value();
    }
    if (kind == ColumnKind::kCode) {
      const auto code = parse_number<int>(text);
      if (!code || *code < 0 || *code > kLargestCode) return false;
      row.codes[codes++] = *code;
      return true;
    }
    const auto real = parse_number<double>(text);
    const double least = kind == ColumnKind::kNonNegative ? 0 : -kLargestReal;
    // Written so that NaN, for which every comparison is false, is refused.
    if (!real || !(*real >= least && *real <= kLargestReal)) return false;
    row.reals[reals++] = *real;
    return true;
  }

  [[nodiscard]] Fault wrong_count(std::span<const Token> tokens, std::size_t line_length) const {
    std::string names;
    for (const Column& column : columns_) {
      names += names.empty() ? "" : ", ";
      names += column.name;
    }
    const bool surplus = tokens.size() > columns_.size();
    // The column of the first word too many, or the end of the line if words are missing.
    const int at = surplus ? tokens[columns_.size()].column : static_cast<int>(line_length) + 1;
    return {
        false, at,
        fmt::format("expected {} columns ({}), found {}", columns_.size(), names, tokens.size())};
  }

  [[nodiscard]] static Fault wrong_value(const Token& token, const Column& column) {
    return {is_non_finite(token.text), token.column,
            fmt::format("{} is `{}`: expected {}", column.name, shown(token.text),
                        expectation(column.kind))};
  }

  std::span<const Column> columns_;
};

/// Walks over the lines of one log.
class LogParser {
 public:
  LogParser(const std::string& file, std::span<const Column> columns, const ParsePolicy& policy)
      : file_(file), reader_(columns), policy_(policy) {}

  Result<ParsedLog> parse(const UnpackedText& log) {
    std::string_view rest = log.text;
    while (!rest.empty()) {
      ++line_;
      const std::size_t newline = rest.find('\n');
      const bool terminated = newline != std::string_view::npos;
      const std::string_view line = rest.substr(0, newline);
      rest.remove_prefix(terminated ? newline + 1 : rest.size());
      if (terminated) {
        RAVE_TRY(take_line(line));
      } else {
        RAVE_TRY(take_last_line(line, log.cut));
      }
    }
    if (log.cut && !cut_reported_) {
      ++line_;
      RAVE_TRY(take_cut(1, "the gzip stream is truncated after the previous line"));
    }
    return std::move(parsed_);
  }

 private:
  Status take_line(std::string_view line) {
    const std::vector<Token> tokens = split(line);
    if (tokens.empty() || tokens.front().text.front() == '#') return {};
    auto row = reader_.read(tokens, line.size(), line_);
    if (row) {
      parsed_.rows.push_back(*row);
      last_decimals_ = decimals(tokens.back().text);
      return {};
    }
    const Fault& fault = row.error();
    if (policy_.bad_rows == BadRowPolicy::kRefuse) {
      return fail_at({file_, line_, fault.column}, ErrorCode::kParse, "{}", fault.message);
    }
    add_repair(fault.non_finite ? RepairKind::kSkippedNonFinite : RepairKind::kSkippedRow);
    return {};
  }

  Status take_last_line(std::string_view line, bool gzip_cut) {
    const std::vector<Token> tokens = split(line);
    const bool comment = tokens.empty() || tokens.front().text.front() == '#';
    if (gzip_cut) {
      return take_cut(static_cast<int>(line.size()) + 1,
                      "the gzip stream ends in the middle of this line");
    }
    if (comment) return {};
    const auto row = reader_.read(tokens, line.size(), line_);
    const bool whole = row.has_value() && decimals(tokens.back().text) >= last_decimals_;
    // A truncated line explains an invalid value only if it is the last one.
    const bool surplus_or_inner =
        !row && (row.error().non_finite || row.error().column < tokens.back().column ||
                 tokens.size() > reader_.column_count());
    if (whole || surplus_or_inner) return take_line(line);
    return take_cut(static_cast<int>(line.size()) + 1, "the log ends in the middle of this line");
  }

  Status take_cut(int column, std::string_view what) {
    cut_reported_ = true;
    if (!policy_.accept_cut) {
      return fail_at({file_, line_, column}, ErrorCode::kParse,
                     "{}; fetch the whole file, or set accept_cut to use the {} whole rows", what,
                     parsed_.rows.size());
    }
    add_repair(RepairKind::kCutLine);
    return {};
  }

  void add_repair(RepairKind kind) {
    for (Repair& repair : parsed_.repairs) {
      if (repair.kind != kind) continue;
      ++repair.count;
      return;
    }
    parsed_.repairs.push_back({kind, 1, line_});
  }

  const std::string& file_;
  RowReader reader_;
  ParsePolicy policy_;
  ParsedLog parsed_;
  int line_ = 0;
  std::size_t last_decimals_ = 0;
  bool cut_reported_ = false;
};

}  // namespace

Result<ParsedLog> parse_log(const UnpackedText& log, const std::string& file,
                            std::span<const Column> columns, const ParsePolicy& policy) {
  return LogParser(file, columns, policy).parse(log);
}

}  // namespace rave::utias
