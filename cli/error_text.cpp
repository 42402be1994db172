// SPDX-License-Identifier: Apache-2.0
#include "error_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "rave/base/control_characters.hpp"
#include "rave/base/file.hpp"

namespace rave::cli {
namespace {

constexpr std::size_t kLargestSource = std::size_t{16} << 20;
constexpr std::size_t kWidestLine = 160;

/// The number at the front of `text`, which must be followed by `: ` or another number.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end == text.data() + text.size() || *end != ':') return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return number;
}

std::optional<std::string> source_line(const SourceLocation& where) {
  const auto content = read_file(where.file, kLargestSource);
  if (!content) return std::nullopt;
  std::string_view rest = *content;
  for (int line = 1; line < where.line; ++line) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    rest.remove_prefix(end + 1);
  }
  std::string text(rest.substr(0, rest.find('\n')));
  // Whatever a file contains, it must not steer the terminal; the caret counts its bytes.
  for (std::size_t at = 0; at < text.size();) {
    const TextCharacter here = character_at(text, at);
    if (here.control && text[at] != '\t') text.replace(at, here.bytes, here.bytes, ' ');
    at += here.bytes;
  }
  return text;
}

bool is_continuation(char c) noexcept { return (static_cast<unsigned char>(c) & 0xc0U) == 0x80U; }

/// The line of the file and a caret below its column, which counts bytes.
std::string excerpt(const SourceLocation& where, const Terminal& terminal) {
  auto line = source_line(where);
  if (!line) return {};
  std::size_t column = static_cast<std::size_t>(std::max(where.column, 1)) - 1;
  column = std::min(column, line->size());
  // A long line, such as a generated one, is cut on both sides so that the column stays in sight.
  if (column > kWidestLine / 2 && line->size() > kWidestLine) {
    std::size_t cut = column - kWidestLine / 2;
    while (cut < column && is_continuation((*line)[cut])) ++cut;
    line->erase(0, cut);
    column -= cut;
  }
  if (line->size() > kWidestLine) {
    std::size_t end = kWidestLine;
    while (end > column && is_continuation((*line)[end])) --end;
    line->resize(end);
  }
  std::string blank;
  for (std::size_t i = 0; i < column; ++i) {
    // Tabs stay tabs, so that the caret stands below its column whatever the width of a tab. A
    // character of several bytes takes one blank.
    if ((*line)[i] == '\t') {
      blank += '\t';
    } else if (!is_continuation((*line)[i])) {
      blank += ' ';
    }
  }
  const std::string number = fmt::format("{:5} | ", where.line);
  return fmt::format("{}{}\n{}{}{}\n", terminal.faint(number), *line, terminal.faint("      | "),
                     blank, terminal.red("^"));
}

}  // namespace

PlacedMessage parse_message(std::string_view line) {
  // The first colon that is followed by a number ends the name of the file: names may have colons.
  for (std::size_t colon = line.find(':'); colon != std::string_view::npos && colon > 0;
       colon = line.find(':', colon + 1)) {
    std::string_view rest = line.substr(colon + 1);
    const auto row = take_number(rest);
    if (!row) continue;
    const auto column = take_number(rest);
    if (!rest.starts_with(' ')) continue;
    return {{std::string(line.substr(0, colon)), *row, column.value_or(0)},
            std::string(rest.substr(1))};
  }
  return {{}, std::string(line)};
}

std::string error_text(const Error& error, const Terminal& terminal) {
  std::string text;
  const std::string whole = error.text();
  std::string_view rest = whole;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const PlacedMessage line = parse_message(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.where.file.empty()) {
      text += line.message + "\n";
      continue;
    }
    text += fmt::format("{}: {}\n", terminal.bold(line.where.text()), terminal.red(line.message));
    if (line.where.line > 0) text += excerpt(line.where, terminal);
  }
  return text;
}

int complain(const Error& error) {
  const Terminal terminal = terminal_of(stderr);
  const std::string before = error.where.file.empty() ? terminal.red("rave: ") : "";
  put(stderr, before + error_text(error, terminal));
  return kBadInput;
}

}  // namespace rave::cli
