// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "people/tab_lines.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/gui_server/accounts.hpp"
#include "visitors/rights_desk.hpp"

namespace rave::gui_server {
namespace {

constexpr std::string_view kFirstRightsLine = "rave-rights 1";
constexpr std::string_view kTeamsWord = "teams:";

std::string reach_text(const std::optional<Reach>& reach) {
  // Of a user only: such a line takes back what the scenario gave them.
  if (!reach) return "usual";
  if (reach->kind != Reach::Kind::kTeams) return std::string(kReaches.of(reach->kind));
  return std::string(kTeamsWord) + Teams{false, reach->teams}.text();
}

/// Nothing: it is no reach.
std::optional<std::optional<Reach>> reach_of(std::string_view text) {
  if (text == "usual") return std::optional<std::optional<Reach>>(std::in_place, std::nullopt);
  if (text.starts_with(kTeamsWord)) {
    auto teams = parse_teams(text.substr(kTeamsWord.size()));
    // All teams have a word of their own, `all`. One form for each reach keeps files comparable.
    if (!teams || teams->all) return std::nullopt;
    return std::optional<Reach>(Reach{Reach::Kind::kTeams, teams->names});
  }
  const auto kind = kReaches.find(text);
  if (!kind) return std::nullopt;
  return std::optional<Reach>(Reach{*kind, {}});
}

Result<KeptChange> change_of(const TabLine& line) {
  RAVE_TRY(line.has(5));
  KeptChange kept;
  kept.run = line[0];
  // The name is printed in messages, where control characters could change a terminal.
  if (has_control_characters(kept.run)) {
    return line.wrong("the name of the run has control characters");
  }
  if (line[1] == "role") {
    kept.change.role = kRoles.find(line[2]);
    // A super-user always has every right; a line that says otherwise is a mistake or an attack.
    if (!kept.change.role || kept.change.role == Role::kSuperUser) {
      return line.wrong("expected observer or commander");
    }
  } else if (line[1] == "user" && check_user_name(line[2])) {
    kept.change.user = line[2];
  } else {
    return line.wrong("expected role or user, with a name");
  }
  const auto what = class_named(line[3]);
  if (!what) return line.wrong("expected a class, such as readings");
  kept.change.what = *what;
  const auto reach = reach_of(line[4]);
  if (!reach) return line.wrong("expected none, own, all, usual or teams:green,blue");
  kept.change.reach = *reach;
  return kept;
}

}  // namespace

Result<std::vector<KeptChange>> parse_rights(std::string_view text, std::string_view file_name) {
  RAVE_TRY_ASSIGN(const auto lines, tab_lines(text, file_name, kFirstRightsLine, "rights"));
  std::vector<KeptChange> changes;
  for (const TabLine& line : lines) {
    RAVE_TRY_ASSIGN(KeptChange kept, change_of(line));
    changes.push_back(std::move(kept));
  }
  return changes;
}

std::string write_rights(const std::vector<KeptChange>& changes) {
  std::string text = std::string(kFirstRightsLine) + "\n";
  for (const KeptChange& kept : changes) {
    text += fmt::format(
        "{}\t{}\t{}\t{}\t{}\n", kept.run, kept.change.role ? "role" : "user",
        kept.change.role ? to_string(*kept.change.role) : std::string_view(kept.change.user),
        to_string(kept.change.what), reach_text(kept.change.reach));
  }
  return text;
}

}  // namespace rave::gui_server
