// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "plain_name.hpp"
#include "rave/gui_server/accounts.hpp"
#include "secrets.hpp"

namespace rave::gui_server {
namespace {

constexpr std::string_view kFirstLine = "rave-accounts 1";
// BLAKE2b-256 in hexadecimal (hash_of()). Invitations and sessions are kept as hashes of their
// secrets, so who reads the file cannot enter with them.
constexpr std::size_t kHashLetters = 64;

using Columns = std::vector<std::string_view>;

Columns columns_of(std::string_view line) {
  Columns columns;
  while (true) {
    const std::string_view column = line.substr(0, line.find('\t'));
    columns.push_back(column);
    if (column.size() == line.size()) return columns;
    line.remove_prefix(column.size() + 1);
  }
}

bool is_hash(std::string_view text) {
  return text.size() == kHashLetters && std::ranges::all_of(text, [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
         });
}

/// One line at a time; each function takes what stands in a column.
class Reader {
 public:
  explicit Reader(std::string_view file_name) { where_.file = file_name; }

  Status take(std::string_view line, int number) {
    where_.line = number;
    const Columns columns = columns_of(line);
    if (columns[0] == "user") return user(columns);
    if (columns[0] == "invitation") return invitation(columns);
    if (columns[0] == "session") return session(columns);
    return wrong("expected user, invitation or session, found `{}`", columns[0].substr(0, 40));
  }
  Status first(std::string_view line) {
    where_.line = 1;
    if (line == kFirstLine) return {};
    return wrong("expected `{}`; not a file of accounts, or one of a later version", kFirstLine);
  }
  [[nodiscard]] AccountsFile finish() {
    // Lines may stand in any order, so only now it is known which sessions have no account.
    std::erase_if(file_.sessions, [this](const SessionEntry& session) {
      return std::ranges::none_of(file_.accounts, [&](const Account& account) {
        return account.person.name == session.user;
      });
    });
    return std::move(file_);
  }

 private:
  template <class... Args>
  tl::unexpected<Error> wrong(fmt::format_string<Args...> format, Args&&... args) {
    return fail_at(where_, ErrorCode::kParse, format, std::forward<Args>(args)...);
  }
  Status count(const Columns& columns, std::size_t expected) {
    if (columns.size() == expected) return {};
    return wrong("expected {} columns, separated by tabs, found {}", expected, columns.size());
  }
  Result<Role> role(std::string_view text) {
    const auto found = kRoles.find(text);
    if (found) return *found;
    return wrong("expected observer, commander or super_user, found `{}`", text.substr(0, 40));
  }
  Result<Teams> teams(std::string_view text) {
    auto found = parse_teams(text);
    if (!found) return wrong("{}", found.error().message);
    return found;
  }
  Result<std::string> hash(std::string_view text) {
    if (!is_hash(text)) return wrong("expected a hash of {} digits", kHashLetters);
    return std::string(text);
  }
  Result<std::string> name(std::string_view text) {
    const Status good = check_user_name(text);
    if (!good) return wrong("{}", good.error().message);
    return std::string(text);
  }
  template <class Number>
  Result<Number> number(std::string_view text, Number most) {
    Number value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // from_chars() stops at the first letter that is no digit, hence the comparison of the end.
    if (error != std::errc() || end != text.data() + text.size() || value < 0 || value > most) {
      return wrong("expected a number up to {}", most);
    }
    return value;
  }

  Status user(const Columns& columns) {
    // Later columns came later; a file without them is as good.
    if (columns.size() != 7) RAVE_TRY(count(columns, 5));
    Account account;
    RAVE_TRY_ASSIGN(account.person.name, name(columns[1]));
    RAVE_TRY_ASSIGN(account.person.role, role(columns[2]));
    RAVE_TRY_ASSIGN(account.person.teams, teams(columns[3]));
    // Guests enter by an invitation and have no password.
    if (columns[4] != "-") {
      if (!is_password_hash(columns[4])) return wrong("expected a hash by Argon2id, or - for none");
      account.password = columns[4];
    }
    if (columns.size() == 7) RAVE_TRY(state(columns, account));
    // Two lines of one name could have two roles, and which counts would depend on their order.
    for (const Account& other : file_.accounts) {
      if (other.person.name == account.person.name) {
        return wrong("`{}` already has an account", account.person.name);
      }
    }
    file_.accounts.push_back(std::move(account));
    return {};
  }

  Status state(const Columns& columns, Account& account) {
    account.disabled = columns[5] == "disabled";
    if (!account.disabled && columns[5] != "enabled") {
      return wrong("expected enabled or disabled, found `{}`", columns[5].substr(0, 40));
    }
    RAVE_TRY_ASSIGN(account.seen_s, number<std::int64_t>(columns[6], 99'999'999'999));
    return {};
  }

  Status invitation(const Columns& columns) {
    RAVE_TRY(count(columns, 7));
    Invitation invitation;
    RAVE_TRY_ASSIGN(invitation.hash, hash(columns[1]));
    RAVE_TRY_ASSIGN(invitation.role, role(columns[2]));
    RAVE_TRY_ASSIGN(invitation.teams, teams(columns[3]));
    RAVE_TRY_ASSIGN(invitation.uses, number<int>(columns[4], 1000));
    RAVE_TRY_ASSIGN(invitation.until_s, number<std::int64_t>(columns[5], 99'999'999'999));
    RAVE_TRY_ASSIGN(invitation.by, name(columns[6]));
    file_.invitations.push_back(std::move(invitation));
    return {};
  }

  Status session(const Columns& columns) {
    RAVE_TRY(count(columns, 4));
    SessionEntry session;
    RAVE_TRY_ASSIGN(session.hash, hash(columns[1]));
    RAVE_TRY_ASSIGN(session.user, name(columns[2]));
    RAVE_TRY_ASSIGN(session.until_s, number<std::int64_t>(columns[3], 99'999'999'999));
    file_.sessions.push_back(std::move(session));
    return {};
  }

  SourceLocation where_;
  AccountsFile file_;
};

}  // namespace

Result<AccountsFile> parse_accounts(std::string_view text, std::string_view file_name) {
  Reader reader(file_name);
  if (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  for (int number = 1;; ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    RAVE_TRY(number == 1 ? reader.first(line) : reader.take(line, number));
    // The last line: nothing is left behind it.
    if (line.size() == text.size()) return reader.finish();
    text.remove_prefix(line.size() + 1);
  }
}

std::string write_accounts(const AccountsFile& accounts) {
  std::string text = std::string(kFirstLine) + "\n";
  for (const Account& account : accounts.accounts) {
    text +=
        fmt::format("user\t{}\t{}\t{}\t{}", account.person.name, to_string(account.person.role),
                    account.person.teams.text(), account.password.empty() ? "-" : account.password);
    // Only where needed, so that versions without these columns can read the file.
    if (account.disabled || account.seen_s > 0) {
      text += fmt::format("\t{}\t{}", account.disabled ? "disabled" : "enabled", account.seen_s);
    }
    text += "\n";
  }
  for (const Invitation& invitation : accounts.invitations) {
    text += fmt::format("invitation\t{}\t{}\t{}\t{}\t{}\t{}\n", invitation.hash,
                        to_string(invitation.role), invitation.teams.text(), invitation.uses,
                        invitation.until_s, invitation.by);
  }
  for (const SessionEntry& session : accounts.sessions) {
    text += fmt::format("session\t{}\t{}\t{}\n", session.hash, session.user, session.until_s);
  }
  return text;
}

Status check_user_name(std::string_view name) {
  // No blanks and no control characters: names stand in columns, logs and links.
  if (is_plain_name(name, "-_.@") && name.size() <= 32 && is_plain(name.front(), "")) return {};
  return fail(ErrorCode::kInvalidArgument,
              "a name has 1 to 32 letters, digits, `-`, `_`, `.` and `@`, the first a letter or "
              "digit");
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
