// SPDX-License-Identifier: Apache-2.0
#include "text_table.hpp"

#include <algorithm>
#include <span>

namespace rave::plugin {
namespace {

constexpr std::size_t kIndent = 2;
constexpr std::size_t kGap = 2;
/// Largest widths of the columns before the sentence: with indent and gaps they fit a page.
constexpr std::array<std::size_t, TextTable::kColumns - 1> kWidest{28, 8, 12, 20, 20};
/// With less room, the sentence goes below its row.
constexpr std::size_t kNarrowSentence = 28;
constexpr std::size_t kSentenceIndent = 6;

/// The number of bytes of the first `count` characters.
std::size_t bytes_of(std::string_view text, std::size_t count) noexcept {
  std::size_t end = 0;
  while (end < text.size()) {
    const bool starts = (static_cast<unsigned char>(text[end]) & 0xC0U) != 0x80U;
    if (starts && count-- == 0) break;
    ++end;
  }
  return end;
}

void trim_end(std::string& line) { line.erase(line.find_last_not_of(' ') + 1); }

/// A row of cells, each with as many lines as it needs.
std::string row_text(std::span<const std::string> cells, std::span<const std::size_t> widths) {
  std::vector<std::vector<std::string>> columns;
  std::size_t height = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    columns.push_back(wrap(cells[i], widths[i]));
    height = std::max(height, columns.back().size());
  }
  std::string text;
  for (std::size_t row = 0; row < height; ++row) {
    std::string line(kIndent, ' ');
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string cell = row < columns[i].size() ? columns[i][row] : std::string();
      line += cell + std::string(widths[i] + kGap - width_of(cell), ' ');
    }
    trim_end(line);
    text += line + "\n";
  }
  return text;
}

}  // namespace

std::size_t width_of(std::string_view text) noexcept {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::vector<std::string> wrap(std::string_view text, std::size_t width) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string> lines(1);
  while (true) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return lines;
    text.remove_prefix(begin);
    std::string_view word = text.substr(0, text.find_first_of(kBlanks));
    text.remove_prefix(word.size());
    if (!lines.back().empty()) {
      if (width_of(lines.back()) + 1 + width_of(word) <= width) {
        lines.back().append(" ").append(word);
        continue;
      }
      lines.emplace_back();
    }
    // A word that is wider than the column is cut, or the table would lose its shape.
    while (width_of(word) > width) {
      const std::size_t cut = bytes_of(word, width);
      lines.back() = word.substr(0, cut);
      lines.emplace_back();
      word.remove_prefix(cut);
    }
    lines.back() = word;
  }
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width) {
  std::string out;
  for (const std::string& line : wrap(text, width - indent)) {
    out += std::string(line.empty() ? 0 : indent, ' ') + line + "\n";
  }
  return out;
}

TextTable::TextTable(const std::array<std::string_view, kColumns>& headings) {
  std::copy(headings.begin(), headings.end(), rows_.emplace_back().begin());
}

std::string TextTable::text() const {
  std::array<std::size_t, kColumns> widths{};
  std::size_t used = kIndent;
  for (std::size_t i = 0; i + 1 < kColumns; ++i) {
    for (const auto& row : rows_) {
      for (const std::string& line : wrap(row[i], kWidest[i])) {
        widths[i] = std::max(widths[i], width_of(line));
      }
    }
    used += widths[i] + kGap;
  }
  const bool below = used + kNarrowSentence > kPageWidth;
  widths.back() = below ? 0 : kPageWidth - used;
  std::string out;
  for (const auto& row : rows_) {
    const std::span<const std::string> cells(row);
    out += row_text(below ? cells.first(kColumns - 1) : cells, widths);
    if (below) out += wrapped(row.back(), kSentenceIndent, kPageWidth);
  }
  return out;
}

}  // namespace rave::plugin
