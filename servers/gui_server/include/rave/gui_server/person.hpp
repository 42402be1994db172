// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::gui_server {

/// Each may do what the one before it may, and more.
enum class Role : std::uint8_t { kObserver, kCommander, kSuperUser };

[[nodiscard]] std::string_view to_string(Role role) noexcept;
/// Of `observer`, `commander` and `super_user`.
[[nodiscard]] std::optional<Role> role_named(std::string_view word) noexcept;

/// Teams that somebody belongs to.
struct Teams {
  bool all = true;
  std::set<std::string, std::less<>> names;  ///< Empty if `all`.

  [[nodiscard]] bool has(std::string_view team) const { return all || names.contains(team); }
  /// `*` for all, `-` for none, otherwise `green,blue`.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Teams&, const Teams&) = default;
};

/// The reverse of Teams::text(). Error kParse: an empty name, or one with a control character.
[[nodiscard]] Result<Teams> parse_teams(std::string_view text);

/// Who looks.
struct Person {
  std::string name;
  Role role = Role::kObserver;
  Teams teams;
  friend bool operator==(const Person&, const Person&) = default;
};

}  // namespace rave::gui_server
