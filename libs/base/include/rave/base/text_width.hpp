// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rave {

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates).
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// The width of the text on a terminal: two columns for East Asian wide characters and emoji, none
/// for combining marks and control characters, one otherwise. Invalid bytes count one each.
[[nodiscard]] std::size_t columns_of(std::string_view text) noexcept;

/// The text without control characters, so that it cannot move the cursor.
[[nodiscard]] std::string without_controls(std::string_view text);

/// The text if it fits into `columns`, otherwise shortened with an ellipsis.
[[nodiscard]] std::string clip_to_columns(std::string_view text, std::size_t columns);

/// Breaks a text at blanks into lines of at most `columns`, which is at least 1; longer words are
/// split. At least one line.
[[nodiscard]] std::vector<std::string> wrap_to_columns(std::string_view text, std::size_t columns);

/// wrap_to_columns() as text: lines are indented and end in a newline; not wider than `columns` in
/// total.
[[nodiscard]] std::string indented(std::string_view text, std::size_t indent, std::size_t columns);

}  // namespace rave
