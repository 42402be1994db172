// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "people/secrets.hpp"
#include "people/tab_lines.hpp"
#include "rave/base/plain_name.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {
namespace {

constexpr std::string_view kFirstLine = "rave-accounts 1";
// BLAKE2b-256 in hexadecimal (hash_of()). Invitations and sessions are kept as hashes of their
// secrets, so who reads the file cannot enter with them.
constexpr std::size_t kHashLetters = 64;
constexpr std::int64_t kLatest_s = 99'999'999'999;

bool is_hash(std::string_view text) {
  return text.size() == kHashLetters && std::ranges::all_of(text, [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

Result<Role> role_at(const TabLine& line, std::size_t column) {
  if (const auto found = kRoles.find(line[column])) return *found;
  return line.wrong("expected observer, commander or super_user, found `{}`",
                    line[column].substr(0, 40));
}

Result<Teams> teams_at(const TabLine& line, std::size_t column) {
  auto found = parse_teams(line[column]);
  if (!found) return line.wrong("{}", found.error().message);
  return found;
}

Result<std::string> hash_at(const TabLine& line, std::size_t column) {
  if (!is_hash(line[column])) return line.wrong("expected a hash of {} digits", kHashLetters);
  return std::string(line[column]);
}

Result<std::string> name_at(const TabLine& line, std::size_t column) {
  const Status good = check_user_name(line[column]);
  if (!good) return line.wrong("{}", good.error().message);
  return std::string(line[column]);
}

template <class Number>
Result<Number> number_at(const TabLine& line, std::size_t column, Number most) {
  const std::string_view text = line[column];
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // from_chars() stops at the first letter that is no digit, hence the comparison of the end.
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most) {
    return line.wrong("expected a number up to {}", most);
  }
  return value;
}

/// Whose name was given, if no column says so. An account with a password was made by a super-user,
/// or by versions that did not ask; without one it is that of a guest.
bool usually_given(const Account& account) { return !account.password.empty(); }

Status take_state(const TabLine& line, Account& account) {
  account.disabled = line[5] == "disabled";
  if (!account.disabled && line[5] != "enabled") {
    return line.wrong("expected enabled or disabled, found `{}`", line[5].substr(0, 40));
  }
  RAVE_TRY_ASSIGN(account.seen_s, number_at<std::int64_t>(line, 6, kLatest_s));
  return {};
}

Status take_user(const TabLine& line, AccountsFile& file) {
  // Later columns came later; a file without them is as good.
  const bool has_name = line.columns.size() == 8;
  const bool has_state = has_name || line.columns.size() == 7;
  if (!has_state) RAVE_TRY(line.has(5));
  Account account;
  RAVE_TRY_ASSIGN(account.person.name, name_at(line, 1));
  RAVE_TRY_ASSIGN(account.person.role, role_at(line, 2));
  RAVE_TRY_ASSIGN(account.person.teams, teams_at(line, 3));
  // Guests enter by an invitation and have no password.
  if (line[4] != "-") {
    if (!is_password_hash(line[4])) return line.wrong("expected a hash by Argon2id, or - for none");
    account.password = line[4];
  }
  if (has_state) RAVE_TRY(take_state(line, account));
  account.person.name_given = has_name ? line[7] == "given" : usually_given(account);
  if (has_name && line[7] != "given" && line[7] != "chosen") {
    return line.wrong("expected given or chosen, found `{}`", line[7].substr(0, 40));
  }
  // Two lines of one name could have two roles, and which counts would depend on their order.
  for (const Account& other : file.accounts) {
    if (other.person.name == account.person.name) {
      return line.wrong("`{}` already has an account", account.person.name);
    }
  }
  file.accounts.push_back(std::move(account));
  return {};
}

Status take_invitation(const TabLine& line, AccountsFile& file) {
  const bool has_name = line.columns.size() == 8;
  if (!has_name) RAVE_TRY(line.has(7));
  Invitation& invitation = file.invitations.emplace_back();
  RAVE_TRY_ASSIGN(invitation.hash, hash_at(line, 1));
  RAVE_TRY_ASSIGN(invitation.role, role_at(line, 2));
  RAVE_TRY_ASSIGN(invitation.teams, teams_at(line, 3));
  RAVE_TRY_ASSIGN(invitation.uses, number_at<int>(line, 4, 1000));
  RAVE_TRY_ASSIGN(invitation.until_s, number_at<std::int64_t>(line, 5, kLatest_s));
  RAVE_TRY_ASSIGN(invitation.by, name_at(line, 6));
  if (has_name) {
    RAVE_TRY_ASSIGN(invitation.name, name_at(line, 7));
  }
  return {};
}

Status take_session(const TabLine& line, AccountsFile& file) {
  RAVE_TRY(line.has(4));
  SessionEntry& session = file.sessions.emplace_back();
  RAVE_TRY_ASSIGN(session.hash, hash_at(line, 1));
  RAVE_TRY_ASSIGN(session.user, name_at(line, 2));
  RAVE_TRY_ASSIGN(session.until_s, number_at<std::int64_t>(line, 3, kLatest_s));
  return {};
}

Status take_line(const TabLine& line, AccountsFile& file) {
  if (line[0] == "user") return take_user(line, file);
  if (line[0] == "invitation") return take_invitation(line, file);
  if (line[0] == "session") return take_session(line, file);
  return line.wrong("expected user, invitation or session, found `{}`", line[0].substr(0, 40));
}

}  // namespace

Result<AccountsFile> parse_accounts(std::string_view text, std::string_view file_name) {
  RAVE_TRY_ASSIGN(const auto lines, tab_lines(text, file_name, kFirstLine, "accounts"));
  AccountsFile file;
  for (const TabLine& line : lines) RAVE_TRY(take_line(line, file));
  // Lines may stand in any order, so only now it is known which sessions have no account.
  std::erase_if(file.sessions, [&file](const SessionEntry& session) {
    return std::ranges::none_of(
        file.accounts, [&](const Account& account) { return account.person.name == session.user; });
  });
  return file;
}

std::string write_accounts(const AccountsFile& accounts) {
  std::string text = std::string(kFirstLine) + "\n";
  for (const Account& account : accounts.accounts) {
    text +=
        fmt::format("user\t{}\t{}\t{}\t{}", account.person.name, to_string(account.person.role),
                    account.person.teams.text(), account.password.empty() ? "-" : account.password);
    // Only where needed, so that versions without these columns can read the file.
    const bool given = account.person.name_given;
    const bool tells_name = given != usually_given(account);
    if (tells_name || account.disabled || account.seen_s > 0) {
      text += fmt::format("\t{}\t{}", account.disabled ? "disabled" : "enabled", account.seen_s);
    }
    if (tells_name) text += given ? "\tgiven" : "\tchosen";
    text += "\n";
  }
  for (const Invitation& invitation : accounts.invitations) {
    text += fmt::format("invitation\t{}\t{}\t{}\t{}\t{}\t{}", invitation.hash,
                        to_string(invitation.role), invitation.teams.text(), invitation.uses,
                        invitation.until_s, invitation.by);
    if (!invitation.name.empty()) text += "\t" + invitation.name;
    text += "\n";
  }
  for (const SessionEntry& session : accounts.sessions) {
    text += fmt::format("session\t{}\t{}\t{}\n", session.hash, session.user, session.until_s);
  }
  return text;
}

Status check_user_name(std::string_view name) {
  if (is_user_name(name)) return {};
  return fail(ErrorCode::kInvalidArgument, "a name has {}", kUserNameRule);
}

Status check_password(std::string_view password) {
  constexpr std::size_t kShortest = 10;
  // The upper limit bounds the work of the hash for a request from the network.
  constexpr std::size_t kLongest = 256;
  if (password.size() >= kShortest && password.size() <= kLongest) return {};
  return fail(ErrorCode::kInvalidArgument, "a password has {} to {} characters", kShortest,
              kLongest);
}

}  // namespace rave::gui_server
