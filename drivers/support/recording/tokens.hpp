// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace rave::recording {

/// A word of a line; views the line.
struct Token {
  std::string_view text;
  int column = 0;  ///< Of its first byte, from 1.
};

/// The words of a line, apart by blanks, tabs and carriage returns.
[[nodiscard]] std::vector<Token> split(std::string_view line);

/// A word shortened to 24 bytes and with unprintable ones replaced, for a message.
[[nodiscard]] std::string shown(std::string_view token);

/// The number that the whole text is; none if it is anything else or out of the type's range.
template <class T>
[[nodiscard]] std::optional<T> parse_number(std::string_view text) noexcept {
  T value{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, value);
  if (status != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace rave::recording
