// SPDX-License-Identifier: Apache-2.0
#include "people/tab_lines.hpp"

#include <string>

namespace rave::gui_server {
namespace {

/// At least one part, which may be empty.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    parts.push_back(text.substr(0, text.find(separator)));
    // The last part: nothing is left behind it.
    if (parts.back().size() == text.size()) return parts;
    text.remove_prefix(parts.back().size() + 1);
  }
}

}  // namespace

Status TabLine::has(std::size_t count) const {
  if (columns.size() == count) return {};
  return wrong("expected {} columns, separated by tabs, found {}", count, columns.size());
}

Result<std::vector<TabLine>> tab_lines(std::string_view text, std::string_view file_name,
                                       std::string_view first, std::string_view content) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  std::vector<TabLine> lines;
  for (const std::string_view line : split(text, '\n')) {
    const int number = static_cast<int>(lines.size()) + 1;
    lines.push_back({split(line, '\t'), {std::string(file_name), number, 0}});
    if (number == 1 && line != first) {
      return lines.back().wrong("expected `{}`; not a file of {}, or one of a later version", first,
                                content);
    }
  }
  lines.erase(lines.begin());
  return lines;
}

}  // namespace rave::gui_server
