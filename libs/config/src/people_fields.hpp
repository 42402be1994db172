// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "file_checks.hpp"
#include "rave/config/people_file.hpp"

// The description of `users:` and `teams:` in scenario files.
namespace rave::config {

constexpr auto enum_names(EnumTag<UserRole> /*tag*/) {
  return std::array{EnumName{UserRole::kObserver, "observer"},
                    EnumName{UserRole::kCommander, "commander"},
                    EnumName{UserRole::kSuperUser, "super_user"}};
}

template <class V>
void describe(V& v, UserFile& c) {
  v.required("name", c.name,
             {.doc = "Name on the page; with several `pages`, -1, -2, ... is added to it."});
  v.field("role", c.role, {.doc = "Role, to which `gui: rights` and its defaults apply."});
  v.field("teams", c.teams,
          {.doc = "Own teams, with those below them; null: the commanded ones, or all.",
           .max_items = 1000});
  v.field("pages", c.pages,
          {.doc = "Number of persons, each with an invitation that `rave run --gui` prints.",
           .min = 0,
           .max = 1000});
}

void validate(const UserFile& c, CheckContext& check);

template <class V>
void describe(V& v, TeamFile& c) {
  v.required("name", c.name, {.doc = "Name, as in `team` of robots."});
  v.field("parent", c.parent, {.doc = "Team that this one belongs to; null: none."});
  v.field("leader", c.leader,
          {.doc = "Robot of the team that leads it, for readers of the scenario; null: none."});
  v.field("commander", c.commander,
          {.doc = "User who alone commands the team and those below it that have no other "
                  "commander; null: users with the team among their `teams`."});
}

template <class V>
void describe(V& v, TeamGift& c) {
  v.required("team", c.team, {.doc = "Team, with those below it."});
  v.required("to", c.to, {.doc = "Commander, or super-user, who alone commands it from then on."});
}

/// Checks users, teams and robots together.
void check_people(const ExpandedScenario& expanded, Diagnostics& diagnostics);

}  // namespace rave::config
