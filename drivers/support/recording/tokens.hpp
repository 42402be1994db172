// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace rave::recording {

/// A word of a line, as a view.
struct Token {
  std::string_view text;
  int column = 0;  ///< Column of its first byte, from 1.
};

/// The words of a line, separated by blanks, tabs and carriage returns.
[[nodiscard]] std::vector<Token> split(std::string_view line);

/// A word for messages: at most 24 bytes, unprintable ones replaced.
[[nodiscard]] std::string shown(std::string_view token);

/// The number that the whole text represents; empty if it is not a number or out of range.
template <class T>
[[nodiscard]] std::optional<T> parse_number(std::string_view text) noexcept {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace rave::recording
