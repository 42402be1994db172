// SPDX-License-Identifier: Apache-2.0
#include "page/people_message.hpp"

namespace rave::gui_server {
namespace {

using AccountDo = AccountMessage::Do;
constexpr WordTable<AccountDo, 4> kAccountWords = {{{"change", AccountDo::kChange},
                                                    {"disable", AccountDo::kDisable},
                                                    {"enable", AccountDo::kEnable},
                                                    {"end_sessions", AccountDo::kEndSessions}}};
/// Whether one is made.
constexpr WordTable<bool, 2> kInvitationWords = {{{"make", true}, {"withdraw", false}}};

constexpr std::size_t kLongestPersonName = 64;
constexpr std::size_t kLongestTeams = 4000;
constexpr std::size_t kLongestFilter = 100;

Result<Teams> teams_in(Members& members) {
  RAVE_TRY_ASSIGN(const std::string text, members.text("teams", kLongestTeams));
  auto teams = parse_teams(text);
  if (!teams) return fail(ErrorCode::kParse, "`teams`: {}", teams.error().message);
  return teams;
}

Result<AccountMessage> account_of_message(Members& members) {
  AccountMessage account;
  RAVE_TRY_ASSIGN(account.request, members.index("request"));
  RAVE_TRY_ASSIGN(account.what, members.choice("do", kAccountWords));
  RAVE_TRY_ASSIGN(account.name, members.text("name", kLongestPersonName));
  // The other actions take neither, and finish() refuses a message that has them.
  if (account.what == AccountDo::kChange) {
    RAVE_TRY_ASSIGN(account.role, members.choice("role", kRoles));
    RAVE_TRY_ASSIGN(account.teams, teams_in(members));
  }
  return account;
}

Result<InvitationMessage> invitation_of_message(Members& members) {
  InvitationMessage invitation;
  RAVE_TRY_ASSIGN(invitation.request, members.index("request"));
  RAVE_TRY_ASSIGN(invitation.make, members.choice("do", kInvitationWords));
  if (!invitation.make) {
    RAVE_TRY_ASSIGN(invitation.id, members.text("id", kLongestPersonName));
    return invitation;
  }
  RAVE_TRY_ASSIGN(invitation.role, members.choice("role", kRoles));
  RAVE_TRY_ASSIGN(invitation.teams, teams_in(members));
  RAVE_TRY_ASSIGN(invitation.uses, members.index_in("uses", 1, 1000));
  RAVE_TRY_ASSIGN(invitation.days, members.index_in("days", 1, 365));
  if (members.has("name")) {
    RAVE_TRY_ASSIGN(invitation.name, members.text("name", kLongestPersonName));
  }
  return invitation;
}

Result<AuditMessage> audit_of_message(Members& members) {
  AuditMessage audit;
  RAVE_TRY_ASSIGN(audit.request, members.index("request"));
  RAVE_TRY_ASSIGN(audit.filter.most, members.index_in("most", 1, kMostAuditLines));
  if (members.has("what")) {
    RAVE_TRY_ASSIGN(audit.filter.what, members.text("what", kLongestFilter));
  }
  if (members.has("contains")) {
    RAVE_TRY_ASSIGN(audit.filter.contains, members.text("contains", kLongestFilter));
  }
  return audit;
}

}  // namespace

std::string_view word_of(const PeopleMessage& message) noexcept {
  if (const auto* const account = std::get_if<AccountMessage>(&message)) {
    return kAccountWords.of(account->what);
  }
  if (const auto* const invitation = std::get_if<InvitationMessage>(&message)) {
    return kInvitationWords.of(invitation->make);
  }
  return "audit";
}

std::uint32_t request_of(const PeopleMessage& message) noexcept {
  return std::visit([](const auto& what) { return what.request; }, message);
}

std::optional<Result<PeopleMessage>> people_message_of(std::string_view type, Members& members) {
  if (type == "account") return account_of_message(members);
  if (type == "invitation") return invitation_of_message(members);
  if (type == "audit") return audit_of_message(members);
  return std::nullopt;
}

}  // namespace rave::gui_server
