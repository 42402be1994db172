// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string_view>

namespace rave {

/// A letter or a digit of ASCII, or one of `signs`.
[[nodiscard]] constexpr bool is_plain(char c, std::string_view signs) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         signs.find(c) != std::string_view::npos;
}

/// Whether a name has plain characters alone, and at least one.
[[nodiscard]] constexpr bool is_plain_name(std::string_view name, std::string_view signs) noexcept {
  return !name.empty() && std::ranges::all_of(name, [signs](char c) { return is_plain(c, signs); });
}

/// Whether a user may have this name: 1 to 32 letters, digits and the signs of kUserNameRule, the
/// first a letter or digit. No blanks and no control characters, since names stand in columns, logs
/// and links; and ASCII alone, where no two letters look the same on purpose.
[[nodiscard]] constexpr bool is_user_name(std::string_view name) noexcept {
  return is_plain_name(name, "-_.@") && name.size() <= 32 && is_plain(name.front(), "");
}

/// What is_user_name() asks for, as a text for people.
inline constexpr const char* kUserNameRule =
    "1 to 32 letters, digits, `-`, `_`, `.` and `@`, the first a letter or digit";

}  // namespace rave
