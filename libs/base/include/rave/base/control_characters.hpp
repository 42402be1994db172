// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rave {

// Characters that steer a terminal instead of being shown: those below U+0020, and U+007F to
// U+009F; in UTF-8, in more bytes than it needs, or as a single byte that is no UTF-8, which is
// what an old terminal sees. Pure; any thread.

/// Whether a text contains such a character.
[[nodiscard]] bool has_control_characters(std::string_view text) noexcept;

/// The text with `instead` in the place of each of them; what else is there stays, bit by bit.
[[nodiscard]] std::string without_control_characters(std::string_view text,
                                                     std::string_view instead);

/// Of the character of `text` that begins at byte `at`, which is less than its size: how many bytes
/// it has, one if it is no UTF-8, and whether it is such a character.
struct TextCharacter {
  std::size_t bytes = 1;
  bool control = false;
};
/// The character that begins at byte `at`, which must be less than the size of `text`.
[[nodiscard]] TextCharacter character_at(std::string_view text, std::size_t at) noexcept;

}  // namespace rave
