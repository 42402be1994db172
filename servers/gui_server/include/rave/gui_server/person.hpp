// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/base/word_table.hpp"

namespace rave::gui_server {

/// The roles of users; each includes the rights of the previous one.
enum class Role : std::uint8_t { kObserver, kCommander, kSuperUser };

inline constexpr WordTable<Role, 3> kRoles = {{{"observer", Role::kObserver},
                                               {"commander", Role::kCommander},
                                               {"super_user", Role::kSuperUser}}};

[[nodiscard]] constexpr std::string_view to_string(Role role) noexcept { return kRoles.of(role); }

/// The teams of a user.
struct Teams {
  bool all = true;
  std::set<std::string, std::less<>> names;  ///< Empty if `all`.

  [[nodiscard]] bool has(std::string_view team) const { return all || names.contains(team); }
  /// `*` for all, `-` for none, otherwise `green,blue`.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Teams&, const Teams&) = default;
};

/// The inverse of Teams::text(). Error kParse: an empty name, or one with a control character.
[[nodiscard]] Result<Teams> parse_teams(std::string_view text);

/// A user.
struct Person {
  std::string name;
  Role role = Role::kObserver;
  Teams teams;
  /// Whether another person gave them the name: a super-user who added the account, or made an
  /// invitation for this name alone. What people choose for themselves is the key of no right.
  bool name_given = false;
  friend bool operator==(const Person&, const Person&) = default;
};

}  // namespace rave::gui_server
