// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rave::report {

/// Whether the bytes are well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates).
[[nodiscard]] bool is_utf8(std::string_view text) noexcept;

/// The columns a terminal gives the text: two for East Asian wide characters and emoji, none for
/// combining marks and control characters, else one. Bytes that are not UTF-8 count one each.
[[nodiscard]] std::size_t columns_of(std::string_view text) noexcept;

/// The text without control characters, so that it cannot move the cursor.
[[nodiscard]] std::string without_controls(std::string_view text);

/// The text if it fits into `columns`, else as much of it as fits with an ellipsis at the end.
[[nodiscard]] std::string clip_to_columns(std::string_view text, std::size_t columns);

}  // namespace rave::report
