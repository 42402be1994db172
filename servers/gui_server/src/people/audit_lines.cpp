// SPDX-License-Identifier: Apache-2.0
#include "people/audit_lines.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

namespace rave::gui_server {
namespace {

std::optional<AuditLine> audit_line(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  AuditLine line;
  for (const auto& [name, field] : kAuditFields) {
    const auto found = json.find(name);
    if (found == json.end()) continue;
    if (!found->is_string()) return std::nullopt;
    line.*field = found->get<std::string>();
  }
  if (line.time.empty() || line.what.empty()) return std::nullopt;
  return line;
}

bool has_text(std::string_view text, std::string_view part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return !std::ranges::search(text, part, same).empty();
}

bool fits(const AuditLine& line, const AuditFilter& filter) {
  if (!filter.what.empty() && line.what != filter.what) return false;
  return filter.contains.empty() || std::ranges::any_of(kAuditFields, [&](const auto& entry) {
           return has_text(line.*entry.second, filter.contains);
         });
}

}  // namespace

void add_audit_lines(std::string_view text, const AuditFilter& filter, AuditPage& page) {
  // What stands behind the last line break is still being written.
  text = text.substr(0, text.rfind('\n') + 1);
  while (!text.empty() && !page.more) {
    text.remove_suffix(1);
    const std::size_t begin = text.rfind('\n') + 1;
    auto line = audit_line(text.substr(begin));
    text = text.substr(0, begin);
    if (!line || !fits(*line, filter)) continue;
    page.more = page.lines.size() >= filter.most;
    if (!page.more) page.lines.push_back(*std::move(line));
  }
}

}  // namespace rave::gui_server
