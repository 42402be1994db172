// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "page/members.hpp"
#include "people/audit_lines.hpp"
#include "rave/gui_server/person.hpp"

// What a super-user asks about people. Nothing of it is trusted.
namespace rave::gui_server {

/// Something about an account.
struct AccountMessage {
  enum class Do : std::uint8_t { kChange, kDisable, kEnable, kEndSessions } what = Do::kChange;
  std::uint32_t request = 0;
  std::string name;
  Role role = Role::kObserver;  ///< Of kChange, as the teams.
  Teams teams{};
};

/// Makes an invitation or takes it back.
struct InvitationMessage {
  bool make = true;
  std::uint32_t request = 0;
  Role role = Role::kObserver;
  Teams teams{};
  std::uint32_t uses = 1;
  std::uint32_t days = 7;
  std::string name;  ///< Of the one person whom it is for; empty: each chooses one.
  std::string id;    ///< Of one that is withdrawn.
};

/// Asks for the newest lines of the audit log.
struct AuditMessage {
  std::uint32_t request = 0;
  AuditFilter filter;  ///< At most kMostAuditLines.
};
inline constexpr std::size_t kMostAuditLines = 1000;

using PeopleMessage = std::variant<AccountMessage, InvitationMessage, AuditMessage>;

/// As answers say it: `change`, `disable`, `make`, `audit` and so on.
[[nodiscard]] std::string_view word_of(const PeopleMessage& message) noexcept;
[[nodiscard]] std::uint32_t request_of(const PeopleMessage& message) noexcept;

/// The messages `account`, `invitation` and `audit`; nothing for any other type. Errors: kParse
/// with what was expected.
[[nodiscard]] std::optional<Result<PeopleMessage>> people_message_of(std::string_view type,
                                                                     Members& members);

}  // namespace rave::gui_server
