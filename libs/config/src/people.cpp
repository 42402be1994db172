// SPDX-License-Identifier: Apache-2.0
// Who commands which teams: one tree of teams, in which the next commander upwards counts.
#include <algorithm>

#include "people_fields.hpp"
#include "rave/base/names.hpp"
#include "rave/base/plain_name.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {
namespace {

/// The teams of a scenario, by name.
class TeamTree {
 public:
  explicit TeamTree(const std::vector<TeamFile>& teams) : teams_(teams) {}

  [[nodiscard]] const TeamFile* find(std::string_view name) const {
    const auto team =
        std::ranges::find_if(teams_, [name](const TeamFile& t) { return *t.name == name; });
    return team == teams_.end() ? nullptr : &*team;
  }
  [[nodiscard]] const TeamFile* parent_of(const TeamFile& team) const {
    return team.parent ? find(**team.parent) : nullptr;
  }
  /// Whether going upwards from a team never ends.
  [[nodiscard]] bool is_cyclic(const TeamFile& team) const {
    const TeamFile* up = parent_of(team);
    for (std::size_t i = 0; up != nullptr && i < teams_.size(); ++i) up = parent_of(*up);
    return up != nullptr;
  }
  /// Whether `name` is this team or above it.
  [[nodiscard]] bool is_within(std::string_view team, std::string_view name) const {
    if (team == name) return true;
    const TeamFile* up = find(team);
    for (; up != nullptr; up = parent_of(*up)) {
      if (*up->name == name) return true;
    }
    return false;
  }
  /// Who alone commands a team; null: no user in particular.
  [[nodiscard]] const Located<std::string>* commander_of(std::string_view name) const {
    for (const TeamFile* team = find(name); team != nullptr; team = parent_of(*team)) {
      if (team->commander) return &*team->commander;
    }
    return nullptr;
  }

 private:
  const std::vector<TeamFile>& teams_;
};

class PeopleChecks {
 public:
  PeopleChecks(const ExpandedScenario& expanded, Diagnostics& diagnostics)
      : expanded_(expanded),
        scenario_(expanded.scenario),
        tree_(scenario_.teams),
        diagnostics_(diagnostics) {}

  void run() {
    collect_names();
    for (const TeamFile& team : scenario_.teams) {
      if (team.parent) team_exists("parent", *team.parent);
    }
    if (!cycles()) return;
    for (const TeamFile& team : scenario_.teams) check_team(team);
    for (const UserFile& user : scenario_.users) check_user(user);
    for (const ChangeFile& change : scenario_.changes) {
      if (!change.give) continue;
      team_exists("team", change.give->team);
      check_commander("to", change.give->to);
    }
    robots();
  }

 private:
  template <class... Args>
  void report(const SourceLocation& where, fmt::format_string<Args...> format, Args&&... args) {
    diagnostics_.add(where, fmt::format(format, std::forward<Args>(args)...));
  }

  /// With `teams`, those; else the teams of robots.
  void collect_names() {
    std::set<std::string_view> names;
    for (const TeamFile& team : scenario_.teams) names.insert(*team.name);
    if (names.empty()) {
      for (const RobotGroup& group : expanded_.groups) names.insert(group.team);
      names.erase("");
    }
    teams_.assign(names.begin(), names.end());
  }

  void team_exists(std::string_view key, const Located<std::string>& name) {
    if (std::ranges::find(teams_, *name) != teams_.end()) return;
    report(name.where, "`{}`: there is no team `{}`{}", key, *name, suggestion(*name, teams_));
  }

  bool cycles() {
    const auto cyclic = std::ranges::find_if(
        scenario_.teams, [this](const TeamFile& team) { return tree_.is_cyclic(team); });
    if (cyclic == scenario_.teams.end()) return true;
    report(cyclic->parent->where, "`parent`: the team `{}` is below itself by way of `{}`",
           *cyclic->name, **cyclic->parent);
    return false;
  }

  void check_team(const TeamFile& team) {
    if (team.leader) check_leader(team, *team.leader);
    if (team.commander) check_commander("commander", *team.commander);
  }

  void check_commander(std::string_view key, const Located<std::string>& name) {
    const auto user =
        std::ranges::find_if(scenario_.users, [&](const UserFile& u) { return *u.name == *name; });
    if (user == scenario_.users.end()) {
      report(name.where, "`{}`: there is no user `{}`{}", key, *name,
             suggestion(*name, names_of(scenario_.users)));
    } else if (user->role == UserRole::kObserver) {
      report(name.where, "`{}`: the user `{}` is an observer; expected `role: commander`", key,
             *name);
    }
  }

  void check_leader(const TeamFile& team, const Located<std::string>& name) {
    const auto robots = robots_named(expanded_, *name);
    if (robots.empty()) {
      return report(name.where, "`leader`: there is no robot `{}`{}", *name,
                    robot_suggestion(expanded_, *name));
    }
    const std::string& own = expanded_.group_of(expanded_.robots[robots.front()]).team;
    if (robots.size() > 1) {
      report(name.where, "`leader`: `{}` stands for several robots; expected one, such as `{}-1`",
             *name, *name);
    } else if (!tree_.is_within(own, *team.name)) {
      report(name.where, "`leader`: robot `{}` belongs to team `{}`, not to `{}`", *name, own,
             *team.name);
    }
  }

  void check_user(const UserFile& user) {
    if (!user.teams) return;
    for (const Located<std::string>& team : *user.teams) {
      team_exists("teams", team);
      const Located<std::string>* const other = tree_.commander_of(*team);
      if (user.role != UserRole::kCommander || other == nullptr || **other == *user.name) continue;
      report(team.where, "`teams`: team `{}` has the commander `{}` ({}); expected one commander",
             *team, **other, other->where.text());
    }
  }

  void robots() {
    if (scenario_.teams.empty()) return;
    for (const RobotGroup& group : expanded_.groups) {
      if (group.team.empty() || tree_.find(group.team) != nullptr) continue;
      report(group.name.where, "`team`: robot `{}` is of team `{}`, which `teams` does not have{}",
             *group.name, group.team, suggestion(group.team, teams_));
    }
  }

  const ExpandedScenario& expanded_;
  const ScenarioFile& scenario_;
  TeamTree tree_;
  std::vector<std::string_view> teams_;
  Diagnostics& diagnostics_;
};

/// All teams that entries or robots name.
std::set<std::string, std::less<>> all_teams(const ExpandedScenario& expanded) {
  std::set<std::string, std::less<>> all;
  for (const TeamFile& team : expanded.scenario.teams) all.insert(*team.name);
  for (const RobotGroup& group : expanded.groups) {
    if (!group.team.empty()) all.insert(group.team);
  }
  return all;
}

/// The teams of a user; empty: all.
std::optional<std::set<std::string, std::less<>>> teams_of(const UserFile& user,
                                                           const ExpandedScenario& expanded) {
  const TeamTree tree(expanded.scenario.teams);
  std::set<std::string, std::less<>> own;
  for (const std::string& team : all_teams(expanded)) {
    const Located<std::string>* const commander = tree.commander_of(team);
    const bool commands = commander != nullptr && **commander == *user.name;
    const bool is_free = commander == nullptr || user.role != UserRole::kCommander;
    const bool listed =
        user.teams && std::ranges::any_of(*user.teams, [&](const Located<std::string>& name) {
          return tree.is_within(team, *name);
        });
    if (commands || (listed && is_free)) own.insert(team);
  }
  // Who is mentioned nowhere sees all, but a commander only if no team has one.
  const bool exclusive = std::ranges::any_of(
      expanded.scenario.teams, [](const TeamFile& team) { return team.commander.has_value(); });
  const bool mentioned = user.teams || !own.empty();
  if (!mentioned && (user.role != UserRole::kCommander || !exclusive)) return std::nullopt;
  return own;
}

}  // namespace

void validate(const UserFile& c, CheckContext& check) {
  // The longest number of a page makes it four characters longer.
  if (is_user_name(*c.name) && (c.pages <= 1 || c.name->size() <= 27)) return;
  check.error("name", "`name`: found `{}`, expected {}", *c.name, kUserNameRule);
}

void check_people(const ExpandedScenario& expanded, Diagnostics& diagnostics) {
  PeopleChecks(expanded, diagnostics).run();
}

std::vector<std::string> teams_within(const ExpandedScenario& scenario, std::string_view team) {
  const TeamTree tree(scenario.scenario.teams);
  std::vector<std::string> within;
  for (const std::string& one : all_teams(scenario)) {
    if (tree.is_within(one, team)) within.push_back(one);
  }
  return within;
}

std::optional<std::pair<std::string, std::string>> TeamGift::parse(std::string_view text) {
  constexpr std::string_view kTo = " to ";
  const std::size_t at = text.find(kTo);
  if (at == std::string_view::npos || at == 0 || at + kTo.size() == text.size()) return {};
  return std::pair(std::string(text.substr(0, at)), std::string(text.substr(at + kTo.size())));
}

std::vector<PlannedPerson> plan_people(const ExpandedScenario& scenario) {
  std::vector<PlannedPerson> people;
  for (const UserFile& user : scenario.scenario.users) {
    const auto teams = teams_of(user, scenario);
    for (int i = 1; i <= user.pages; ++i) {
      const std::string name = user.pages == 1 ? *user.name : fmt::format("{}-{}", *user.name, i);
      people.push_back({name, user.role, teams});
    }
  }
  return people;
}

}  // namespace rave::config
