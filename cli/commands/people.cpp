// SPDX-License-Identifier: Apache-2.0
#include "commands/people.hpp"

#include <fmt/format.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "error_text.hpp"
#include "rave/base/file.hpp"
#include "rave/base/table.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::cli {
namespace {

using gui_server::Accounts;
using gui_server::Role;
using gui_server::Teams;

/// The terminal shows nothing of what is typed while this lives.
class NoEcho {
 public:
  NoEcho() : terminal_(::tcgetattr(STDIN_FILENO, &before_) == 0) {
    if (!terminal_) return;
    termios quiet = before_;
    quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &quiet);
  }
  NoEcho(const NoEcho&) = delete;
  NoEcho& operator=(const NoEcho&) = delete;
  ~NoEcho() {
    if (terminal_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  [[nodiscard]] bool terminal() const noexcept { return terminal_; }

 private:
  termios before_{};
  bool terminal_;
};

Result<std::string> read_password() {
  std::string first;
  std::string second;
  const NoEcho quiet;
  // A script gives it once: a script does not mistype.
  if (!quiet.terminal()) {
    std::getline(std::cin, first);
    return first;
  }
  put(stderr, "password: ");
  std::getline(std::cin, first);
  put(stderr, "\nagain: ");
  std::getline(std::cin, second);
  put(stderr, "\n");
  if (first != second) return fail(ErrorCode::kInvalidArgument, "the two passwords differ");
  return first;
}

Result<Role> role_of(const std::string& word) {
  const auto role = gui_server::kRoles.find(word);
  if (role) return *role;
  return fail(ErrorCode::kInvalidArgument,
              "there is no role `{}`; there are observer, commander and super_user", word);
}

std::string user_name() {
  const char* const name = std::getenv("USER");
  return name != nullptr && gui_server::check_user_name(name) ? name : "operator";
}

Result<std::string> add(Accounts& accounts, const PeopleCommand& options) {
  RAVE_TRY_ASSIGN(const Role role, role_of(options.role));
  RAVE_TRY_ASSIGN(const Teams teams, gui_server::parse_teams(options.teams));
  // Before the password is asked for, so that it is not typed in vain.
  RAVE_TRY(gui_server::check_user_name(options.name));
  RAVE_TRY_ASSIGN(const std::string password, read_password());
  RAVE_TRY(accounts.add({options.name, role, teams}, password));
  return fmt::format("added {} as {}\n", options.name, to_string(role));
}

Result<std::string> invite(Accounts& accounts, const PeopleCommand& options) {
  RAVE_TRY_ASSIGN(const Role role, role_of(options.role));
  RAVE_TRY_ASSIGN(const Teams teams, gui_server::parse_teams(options.teams));
  RAVE_TRY_ASSIGN(const std::string secret, accounts.invite(role, teams, options.uses, options.days,
                                                            user_name(), options.name));
  // A server that was started with these accounts has left where it is.
  const auto address = read_file(accounts.folder() / "address", 1000);
  const std::string where = address ? address->substr(0, address->find('\n')) : "";
  const std::string people = !options.name.empty() ? options.name
                             : options.uses == 1   ? "one person"
                                                   : fmt::format("{} people", options.uses);
  return fmt::format("{}/join?invite={}\n{}for {} as {}, within {} days\n", where, secret,
                     where.empty() ? "append it to the address of the page; " : "", people,
                     to_string(role), options.days);
}

std::int64_t days_until(std::int64_t moment_s) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return (moment_s - std::chrono::duration_cast<std::chrono::seconds>(now).count()) / 86'400;
}

std::string list(const Accounts& accounts) {
  const gui_server::AccountsFile file = accounts.state();
  Table table;
  table.columns = {{.heading = "name", .least = 32},
                   {.heading = "role", .least = 10},
                   {.heading = "password", .least = 8},
                   {.heading = "name was", .least = 8},
                   {.heading = "teams"}};
  for (const auto& account : file.accounts) {
    table.rows.push_back({account.person.name, std::string(to_string(account.person.role)),
                          account.password.empty() ? "no" : "yes",
                          account.person.name_given ? "given" : "chosen",
                          account.person.teams.text()});
  }
  std::string text = render_table(table, {.look = TableLook::kSpaces});
  for (const auto& invitation : file.invitations) {
    const bool named = !invitation.name.empty();
    text += fmt::format("invitation by {}{}{}: {}, teams {}, {} left, {} days\n", invitation.by,
                        named ? " for " : "", invitation.name, to_string(invitation.role),
                        invitation.teams.text(), invitation.uses, days_until(invitation.until_s));
  }
  return text;
}

Result<std::string> do_it(const PeopleCommand& options) {
  const auto folder =
      options.folder.empty() ? Accounts::usual_folder() : std::filesystem::path(options.folder);
  RAVE_TRY_ASSIGN(const auto accounts, Accounts::open(folder));
  switch (options.what) {
    case PeopleCommand::What::kAdd:
      return add(*accounts, options);
    case PeopleCommand::What::kInvite:
      return invite(*accounts, options);
    case PeopleCommand::What::kList:
      return list(*accounts);
    case PeopleCommand::What::kRemove:
      RAVE_TRY(accounts->remove(options.name));
      // A server reads the file of accounts twice a second.
      return fmt::format("removed {}; open sessions end within a second\n", options.name);
    case PeopleCommand::What::kUninvite: {
      RAVE_TRY_ASSIGN(const std::size_t count, accounts->revoke_invitations());
      return fmt::format("withdrew {} invitation{}\n", count, count == 1 ? "" : "s");
    }
  }
  return std::string();
}

}  // namespace

Result<int> people(const PeopleCommand& options) {
  RAVE_TRY_ASSIGN(const auto done, do_it(options));
  put(stdout, done);
  return kGood;
}

}  // namespace rave::cli
