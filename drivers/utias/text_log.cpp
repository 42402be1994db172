// SPDX-License-Identifier: Apache-2.0
#include "utias/text_log.hpp"

#include <cmath>
#include <optional>

#include "recording/line_parser.hpp"
#include "utias/recording_names.hpp"

namespace rave::utias {
namespace {

using recording::parse_number;
using recording::shown;
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

class LogParser final : recording::LineParser {
 public:
  LogParser(const std::string& file, std::span<const Column> columns, bool accept_cut)
      : LineParser(file, accept_cut), reader_(columns) {}

  Result<ParsedLog> parse(const UnpackedText& log) {
    RAVE_TRY(parse_lines(log));
    return std::move(parsed_);
  }

 private:
  Status take_line() override {
    const auto row = reader_.read(words_, line_text_.size(), line_);
    if (!row) {
      return fail_at({file_, line_, row.error().column}, ErrorCode::kParse, "{}",
                     row.error().message);
    }
    parsed_.rows.push_back(*row);
    last_decimals_ = decimals(words_.back().text);
    return {};
  }

  Status take_last_line() override {
    const auto row = reader_.read(words_, line_text_.size(), line_);
    const bool whole = row.has_value() && decimals(words_.back().text) >= last_decimals_;
    // A truncated line explains an invalid value only if it is the last one.
    const bool surplus_or_inner =
        !row && (row.error().non_finite || row.error().column < words_.back().column ||
                 words_.size() > reader_.column_count());
    return whole || surplus_or_inner ? take_line() : LineParser::take_last_line();
  }

  std::string whole() const override { return fmt::format("{} whole rows", parsed_.rows.size()); }
  std::vector<Repair>& cut_repairs() override { return parsed_.repairs; }

  RowReader reader_;
  ParsedLog parsed_;
  std::size_t last_decimals_ = 0;
};

}  // namespace

Result<ParsedLog> parse_log(const UnpackedText& log, const std::string& file,
                            std::span<const Column> columns, bool accept_cut) {
  return LogParser(file, columns, accept_cut).parse(log);
}

}  // namespace rave::utias
