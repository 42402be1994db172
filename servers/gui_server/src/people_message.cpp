// SPDX-License-Identifier: Apache-2.0
#include "people_message.hpp"

#include <array>

namespace rave::gui_server {
namespace {

using AccountDo = AccountMessage::Do;
// In the order of AccountDo, because word_of() uses it as index.
constexpr std::array<std::pair<std::string_view, AccountDo>, 4> kAccountWords = {
    {{"change", AccountDo::kChange},
     {"disable", AccountDo::kDisable},
     {"enable", AccountDo::kEnable},
     {"end_sessions", AccountDo::kEndSessions}}};

constexpr std::size_t kLongestPersonName = 64;
constexpr std::size_t kLongestTeams = 4000;
constexpr std::size_t kLongestFilter = 100;

Result<Role> role_in(Members& members) {
  RAVE_TRY_ASSIGN(const std::string word, members.word("role"));
  if (const auto role = kRoles.find(word)) return *role;
  return fail(ErrorCode::kParse, "`role`: expected observer, commander or super_user");
}

Result<Teams> teams_in(Members& members) {
  RAVE_TRY_ASSIGN(const std::string text, members.text("teams", kLongestTeams));
  auto teams = parse_teams(text);
  if (!teams) return fail(ErrorCode::kParse, "`teams`: {}", teams.error().message);
  return teams;
}

Result<std::uint32_t> count_in(Members& members, const char* name, std::uint32_t most) {
  RAVE_TRY_ASSIGN(const std::uint32_t count, members.index(name));
  if (count >= 1 && count <= most) return count;
  return fail(ErrorCode::kParse, "`{}`: expected 1 to {}", name, most);
}

Result<PeopleMessage> account_of_message(Members& members) {
  AccountMessage account;
  RAVE_TRY_ASSIGN(account.request, members.index("request"));
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  const auto* const known =
      std::find_if(kAccountWords.begin(), kAccountWords.end(),
                   [&word](const auto& entry) { return entry.first == word; });
  if (known == kAccountWords.end()) {
    return fail(ErrorCode::kParse, "`do`: expected change, disable, enable or end_sessions");
  }
  account.what = known->second;
  RAVE_TRY_ASSIGN(account.name, members.text("name", kLongestPersonName));
  // The other actions take neither, and finish() refuses a message that has them.
  if (account.what == AccountDo::kChange) {
    RAVE_TRY_ASSIGN(account.role, role_in(members));
    RAVE_TRY_ASSIGN(account.teams, teams_in(members));
  }
  return PeopleMessage(std::move(account));
}

Result<PeopleMessage> invitation_of_message(Members& members) {
  InvitationMessage invitation;
  RAVE_TRY_ASSIGN(invitation.request, members.index("request"));
  RAVE_TRY_ASSIGN(const std::string word, members.word("do"));
  invitation.make = word == "make";
  if (word == "withdraw") {
    RAVE_TRY_ASSIGN(invitation.id, members.text("id", kLongestPersonName));
    return PeopleMessage(std::move(invitation));
  }
  if (!invitation.make) return fail(ErrorCode::kParse, "`do`: expected make or withdraw");
  RAVE_TRY_ASSIGN(invitation.role, role_in(members));
  RAVE_TRY_ASSIGN(invitation.teams, teams_in(members));
  RAVE_TRY_ASSIGN(invitation.uses, count_in(members, "uses", 1000));
  RAVE_TRY_ASSIGN(invitation.days, count_in(members, "days", 365));
  return PeopleMessage(std::move(invitation));
}

Result<PeopleMessage> audit_of_message(Members& members) {
  AuditMessage audit;
  RAVE_TRY_ASSIGN(audit.request, members.index("request"));
  RAVE_TRY_ASSIGN(audit.filter.most, count_in(members, "most", kMostAuditLines));
  if (members.has("what")) {
    RAVE_TRY_ASSIGN(audit.filter.what, members.text("what", kLongestFilter));
  }
  if (members.has("contains")) {
    RAVE_TRY_ASSIGN(audit.filter.contains, members.text("contains", kLongestFilter));
  }
  return PeopleMessage(std::move(audit));
}

}  // namespace

std::string_view word_of(const PeopleMessage& message) noexcept {
  if (const auto* const account = std::get_if<AccountMessage>(&message)) {
    return kAccountWords[static_cast<std::size_t>(account->what)].first;
  }
  if (const auto* const invitation = std::get_if<InvitationMessage>(&message)) {
    return invitation->make ? "make" : "withdraw";
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
