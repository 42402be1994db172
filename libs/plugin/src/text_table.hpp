// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rave::plugin {

/// Width of a page in characters.
inline constexpr std::size_t kPageWidth = 100;

/// The number of characters of a UTF-8 text.
[[nodiscard]] std::size_t width_of(std::string_view text) noexcept;

/// Breaks a text at blanks into lines of at most `width` characters; longer words are split. At
/// least one line.
[[nodiscard]] std::vector<std::string> wrap(std::string_view text, std::size_t width);

/// wrap() as text: lines are indented and end in a newline; not wider than `width` in total.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t indent, std::size_t width);

/// A table for a terminal: narrow columns, then a sentence. Long cells continue in the next line of
/// their column.
class TextTable {
 public:
  static constexpr std::size_t kColumns = 6;

  explicit TextTable(const std::array<std::string_view, kColumns>& headings);
  void add(std::array<std::string, kColumns> row) { rows_.push_back(std::move(row)); }

  /// No line is wider than kPageWidth and none ends in a blank.
  [[nodiscard]] std::string text() const;

 private:
  std::vector<std::array<std::string, kColumns>> rows_;
};

}  // namespace rave::plugin
