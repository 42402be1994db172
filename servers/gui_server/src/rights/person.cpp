// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/person.hpp"

#include <fmt/format.h>

#include "rave/base/control_characters.hpp"

namespace rave::gui_server {

std::string Teams::text() const {
  if (all) return "*";
  return names.empty() ? "-" : fmt::format("{}", fmt::join(names, ","));
}

Result<Teams> parse_teams(std::string_view text) {
  Teams teams;
  if (text == "*") return teams;
  teams.all = false;
  if (text == "-") return teams;
  while (true) {
    const std::string_view name = text.substr(0, text.find(','));
    if (name.empty() || name.size() > 64 || has_control_characters(name)) {
      return fail(ErrorCode::kParse,
                  "expected teams such as green,blue, or * for all, or - for none");
    }
    teams.names.emplace(name);
    if (name.size() == text.size()) return teams;
    text.remove_prefix(name.size() + 1);
  }
}

}  // namespace rave::gui_server
