// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/config/described.hpp"

namespace rave::config {

struct ExpandedScenario;

enum class UserRole : std::uint8_t { kObserver, kCommander, kSuperUser };

/// One entry of `users:`: a person whom `rave run --gui` invites. Users and teams of persons are
/// not part of the run, so the processes of a run may have different values.
struct UserFile {
  /// Of `pages` persons, a prefix to which `-1`, `-2`, … is appended.
  Located<std::string> name;
  UserRole role = UserRole::kObserver;
  /// Unset: what the user commands if `teams` of the scenario says so, else all teams.
  std::optional<std::vector<Located<std::string>>> teams;
  int pages = 1;
  bool operator==(const UserFile&) const = default;
};

/// One entry of `teams:`: a team that `team` of robots names, or one that consists of others.
struct TeamFile {
  Located<std::string> name;
  std::optional<Located<std::string>> parent;
  /// A robot of the team or of a team below it.
  std::optional<Located<std::string>> leader;
  /// A user who alone commands the team, and the teams below it without a commander of their own.
  std::optional<Located<std::string>> commander;
  bool operator==(const TeamFile&) const = default;
};

/// Of a change: the user who alone commands a team and those below it from then on.
struct TeamGift {
  Located<std::string> team;
  Located<std::string> to;
  bool operator==(const TeamGift&) const = default;

  /// As events tell it: `red to anna`. A team has no space in its name.
  [[nodiscard]] static std::string text(std::string_view team, std::string_view to) {
    return fmt::format("{} to {}", team, to);
  }
  /// Inverse of text(): team and user; empty if it is none.
  [[nodiscard]] static std::optional<std::pair<std::string, std::string>> parse(
      std::string_view text);
};

/// A person of the run.
struct PlannedPerson {
  std::string name;
  UserRole role = UserRole::kObserver;
  std::optional<std::set<std::string, std::less<>>> teams;  ///< Unset: all.
  bool operator==(const PlannedPerson&) const = default;
};

/// The persons of a scenario that was expanded, with the teams below theirs. Sorted as in the file.
[[nodiscard]] std::vector<PlannedPerson> plan_people(const ExpandedScenario& scenario);
/// A team and those below it, sorted by name.
[[nodiscard]] std::vector<std::string> teams_within(const ExpandedScenario& scenario,
                                                    std::string_view team);

}  // namespace rave::config
