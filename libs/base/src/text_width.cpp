// SPDX-License-Identifier: Apache-2.0
#include "rave/base/text_width.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "rave/base/control_characters.hpp"
#include "rave/base/utf8.hpp"

namespace rave {
namespace {

struct CodePoint {
  std::uint32_t value = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

struct Range {
  std::uint32_t first;
  std::uint32_t last;
};

/// The code point at the start of non-empty `text`; of what is none, the first byte.
CodePoint code_point(std::string_view text) noexcept {
  const Utf8Character character = utf8_at(text, 0);
  if (character.length > 0) return {character.code, character.length, true};
  return {static_cast<std::uint8_t>(text[0]), 1, false};
}

/// The blocks without width on terminals.
constexpr std::array kZeroWidth = {Range{0x0300, 0x036F}, Range{0x200B, 0x200F},
                                   Range{0x20D0, 0x20FF}, Range{0xFE00, 0xFE0F},
                                   Range{0xFE20, 0xFE2F}, Range{0xFEFF, 0xFEFF}};
/// The blocks whose East Asian width is W or F (Unicode Annex 11), to block precision.
constexpr std::array kWide = {
    Range{0x1100, 0x115F},   Range{0x2E80, 0x303E},   Range{0x3041, 0xA4CF},
    Range{0xAC00, 0xD7A3},   Range{0xF900, 0xFAFF},   Range{0xFE30, 0xFE6F},
    Range{0xFF00, 0xFF60},   Range{0xFFE0, 0xFFE6},   Range{0x1F300, 0x1F64F},
    Range{0x1F680, 0x1F6FF}, Range{0x1F900, 0x1F9FF}, Range{0x20000, 0x3FFFD}};

std::size_t columns_of(CodePoint point) noexcept {
  const auto in = [&](const Range& range) {
    return point.value >= range.first && point.value <= range.last;
  };
  if (!point.valid) return 1;
  if (point.value < 0x20 || (point.value >= 0x7F && point.value < 0xA0)) return 0;
  if (std::any_of(kZeroWidth.begin(), kZeroWidth.end(), in)) return 0;
  return std::any_of(kWide.begin(), kWide.end(), in) ? 2 : 1;
}

/// The number of bytes of as many characters as fit, and of one at least.
std::size_t bytes_within(std::string_view text, std::size_t columns) noexcept {
  std::size_t used = 0;
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const CodePoint point = code_point(text.substr(bytes));
    used += columns_of(point);
    if (used > columns && bytes > 0) break;
    bytes += point.bytes;
  }
  return bytes;
}

}  // namespace

bool is_utf8(std::string_view text) noexcept { return first_invalid_utf8(text) == text.size(); }

std::size_t columns_of(std::string_view text) noexcept {
  std::size_t columns = 0;
  while (!text.empty()) {
    const CodePoint point = code_point(text);
    columns += columns_of(point);
    text.remove_prefix(point.bytes);
  }
  return columns;
}

std::string without_controls(std::string_view text) { return without_control_characters(text, ""); }

std::string clip_to_columns(std::string_view text, std::size_t columns) {
  if (columns_of(text) <= columns) return std::string(text);
  if (columns == 0) return {};
  std::size_t used = 0;
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const CodePoint point = code_point(text.substr(bytes));
    if (used + columns_of(point) > columns - 1) break;
    used += columns_of(point);
    bytes += point.bytes;
  }
  return std::string(text.substr(0, bytes)) + "…";
}

std::vector<std::string> wrap_to_columns(std::string_view text, std::size_t columns) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string> lines(1);
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return lines;
    text.remove_prefix(begin);
    std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if (!lines.back().empty()) {
      if (columns_of(lines.back()) + 1 + columns_of(word) <= columns) {
        lines.back().append(" ").append(word);
        continue;
      }
      lines.emplace_back();
    }
    while (columns_of(word) > columns) {
      const std::size_t cut = bytes_within(word, columns);
      lines.back() = word.substr(0, cut);
      lines.emplace_back();
      word.remove_prefix(cut);
    }
    lines.back() = word;
  }
}

std::string indented(std::string_view text, std::size_t indent, std::size_t columns) {
  std::string out;
  for (const std::string& line : wrap_to_columns(text, columns - indent)) {
    out += std::string(line.empty() ? 0 : indent, ' ') + line + "\n";
  }
  return out;
}

}  // namespace rave
