// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rave {

// Control characters: U+0000 to U+001F and U+007F to U+009F. They steer a terminal instead of being
// shown. Overlong UTF-8 encodings of them count too, and so do single bytes in that range that are
// not valid UTF-8, because old terminals obey them. Pure functions; any thread.

/// Whether `text` contains a control character.
[[nodiscard]] bool has_control_characters(std::string_view text) noexcept;

/// A copy of `text` with each control character replaced by `instead`. All other bytes are
/// unchanged.
[[nodiscard]] std::string without_control_characters(std::string_view text,
                                                     std::string_view instead);

/// One character of a text: its length in bytes (1 if it is not valid UTF-8), and whether it is a
/// control character.
struct TextCharacter {
  std::size_t bytes = 1;
  bool control = false;
};
/// The character that begins at byte `at`, which must be less than the size of `text`.
[[nodiscard]] TextCharacter character_at(std::string_view text, std::size_t at) noexcept;

}  // namespace rave
