// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rave::report {

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates).
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// The width of the text on a terminal: two columns for East Asian wide characters and emoji, none
/// for combining marks and control characters, one otherwise. Invalid bytes count one each.
[[nodiscard]] std::size_t columns_of(std::string_view text) noexcept;

/// The text without control characters, so that it cannot move the cursor.
[[nodiscard]] std::string without_controls(std::string_view text);

/// The text if it fits into `columns`, otherwise shortened with an ellipsis.
[[nodiscard]] std::string clip_to_columns(std::string_view text, std::size_t columns);

}  // namespace rave::report
