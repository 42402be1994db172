// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "rave/base/control_characters.hpp"
#include "rave/gui_server/accounts.hpp"
#include "rights_desk.hpp"

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

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> columns;
  while (true) {
    columns.push_back(line.substr(0, line.find('\t')));
    if (columns.back().size() == line.size()) return columns;
    line.remove_prefix(columns.back().size() + 1);
  }
}

Result<KeptChange> change_of(std::string_view line, const SourceLocation& where) {
  const auto columns = split(line);
  if (columns.size() != 5) {
    return fail_at(where, ErrorCode::kParse, "expected 5 columns, separated by tabs, found {}",
                   columns.size());
  }
  KeptChange kept;
  kept.run = columns[0];
  // The name is printed in messages, where control characters could change a terminal.
  if (has_control_characters(kept.run)) {
    return fail_at(where, ErrorCode::kParse, "the name of the run has control characters");
  }
  if (columns[1] == "role") {
    kept.change.role = kRoles.find(columns[2]);
    // A super-user always has every right; a line that says otherwise is a mistake or an attack.
    if (!kept.change.role || kept.change.role == Role::kSuperUser) {
      return fail_at(where, ErrorCode::kParse, "expected observer or commander");
    }
  } else if (columns[1] == "user" && check_user_name(columns[2])) {
    kept.change.user = columns[2];
  } else {
    return fail_at(where, ErrorCode::kParse, "expected role or user, and which");
  }
  const auto what = class_named(columns[3]);
  if (!what) return fail_at(where, ErrorCode::kParse, "expected a class, such as readings");
  kept.change.what = *what;
  const auto reach = reach_of(columns[4]);
  if (!reach) {
    return fail_at(where, ErrorCode::kParse, "expected none, own, all, usual or teams:green,blue");
  }
  kept.change.reach = *reach;
  return kept;
}

}  // namespace

Result<std::vector<KeptChange>> parse_rights(std::string_view text, std::string_view file_name) {
  SourceLocation where{std::string(file_name), 0, 0};
  std::vector<KeptChange> changes;
  if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  while (true) {
    ++where.line;
    const std::string_view line = text.substr(0, text.find('\n'));
    if (where.line > 1) {
      RAVE_TRY_ASSIGN(KeptChange kept, change_of(line, where));
      changes.push_back(std::move(kept));
    } else if (line != kFirstRightsLine) {
      return fail_at(where, ErrorCode::kParse,
                     "expected `{}`; not a file of rights, or one of a later version",
                     kFirstRightsLine);
    }
    if (line.size() == text.size()) return changes;
    text.remove_prefix(line.size() + 1);
  }
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
