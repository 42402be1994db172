// SPDX-License-Identifier: Apache-2.0
#include "rave/base/control_characters.hpp"

namespace rave {
namespace {

constexpr bool is_control(unsigned code) noexcept {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

/// The number of continuation bytes after a lead byte; 0: not a lead byte.
constexpr std::size_t followers(unsigned first) noexcept {
  if (first >= 0xc0 && first < 0xe0) return 1;
  if (first >= 0xe0 && first < 0xf0) return 2;
  return first >= 0xf0 && first < 0xf8 ? 3 : 0;
}

}  // namespace

TextCharacter character_at(std::string_view text, std::size_t at) noexcept {
  const unsigned first = static_cast<unsigned char>(text[at]);
  const std::size_t more = followers(first);
  if (more == 0 || text.size() - at <= more) return {1, is_control(first)};
  unsigned code = first & (0x3fU >> more);
  for (std::size_t i = 1; i <= more; ++i) {
    const unsigned next = static_cast<unsigned char>(text[at + i]);
    // Not UTF-8: this byte counts alone, and the next one begins anew.
    if ((next & 0xc0U) != 0x80U) return {1, false};
    code = (code << 6U) | (next & 0x3fU);
  }
  return {more + 1, is_control(code)};
}

bool has_control_characters(std::string_view text) noexcept {
  for (std::size_t at = 0; at < text.size();) {
    const TextCharacter here = character_at(text, at);
    if (here.control) return true;
    at += here.bytes;
  }
  return false;
}

std::string without_control_characters(std::string_view text, std::string_view instead) {
  std::string clean;
  clean.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const TextCharacter here = character_at(text, at);
    clean += here.control ? instead : text.substr(at, here.bytes);
    at += here.bytes;
  }
  return clean;
}

}  // namespace rave
