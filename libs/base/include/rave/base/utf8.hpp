// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace rave {

/// One character of a UTF-8 text: its code point, and its length in bytes.
struct Utf8Character {
  std::uint32_t code = 0;
  std::size_t length = 0;
};

/// The character at `offset`. Its length is 0 if the bytes there are invalid (RFC 3629: no overlong
/// forms, no surrogates, nothing above U+10FFFF). `offset` is below the size of the text.
[[nodiscard]] inline Utf8Character utf8_at(std::string_view text, std::size_t offset) noexcept {
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return offset + i < text.size() ? static_cast<unsigned char>(text[offset + i]) : 0U;
  };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return {};
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = (code << 6) | (byte(i) & 0x3FU);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  if (overlong || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, length};
}

/// The offset of the first byte that is not UTF-8, or the size of the text.
[[nodiscard]] inline std::size_t first_invalid_utf8(std::string_view text) noexcept {
  std::size_t i = 0;
  while (i < text.size()) {
    const Utf8Character c = utf8_at(text, i);
    if (c.length == 0) return i;
    i += c.length;
  }
  return i;
}

}  // namespace rave
