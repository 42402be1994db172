// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/gui_server/person.hpp"

// The user accounts of a server, in the file `accounts` of a private folder. Passwords are stored
// as Argon2id; the secrets of links and sessions, which are random, as a plain hash. Times are
// seconds since 1970.
namespace rave::gui_server {

struct Account {
  Person person;
  /// In the format of libsodium; empty: joined by a link without a password.
  std::string password;
  bool disabled = false;    ///< Cannot sign in; the name stays reserved.
  std::int64_t seen_s = 0;  ///< When their last page was closed, or they signed in; 0: never.
};

struct Invitation {
  std::string hash;
  Role role = Role::kObserver;
  Teams teams;
  int uses = 1;  ///< Remaining uses.
  std::int64_t until_s = 0;
  std::string by;  ///< Name of its creator.
  /// Name of the one person whom it is for; empty: each person chooses one.
  std::string name{};

  /// An id to show to people. The secret cannot be derived from it.
  [[nodiscard]] std::string id() const { return hash.substr(0, 16); }
};

using NameSet = std::set<std::string, std::less<>>;

struct SessionEntry {
  std::string hash;
  std::string user;
  std::int64_t until_s = 0;
};

struct AccountsFile {
  std::vector<Account> accounts;
  std::vector<Invitation> invitations;
  std::vector<SessionEntry> sessions;
};

/// Parses the file. Strict: error kParse with the line of anything unknown. Sessions without an
/// account, left when a line was removed by hand, are dropped.
[[nodiscard]] Result<AccountsFile> parse_accounts(std::string_view text,
                                                  std::string_view file_name);
[[nodiscard]] std::string write_accounts(const AccountsFile& accounts);

/// Checks a user name (is_user_name()). Error kInvalidArgument.
[[nodiscard]] Status check_user_name(std::string_view name);
/// Checks the length of a password: at least 10 characters, and an upper limit. Error
/// kInvalidArgument.
[[nodiscard]] Status check_password(std::string_view password);

/// The accounts of a server. Any thread; several processes may use the same folder. add(), join()
/// and sign_in() take a tenth of a second for the password hash, so do not call them in the thread
/// of a server.
class Accounts {
 public:
  using Clock = std::function<std::int64_t()>;
  static constexpr std::int64_t kSessionLife_s = 7 * 86'400;

  /// Opens the folder, or creates it (0700). Errors: kState (others can read it), kIo, kParse.
  /// `clock`: null for the system clock.
  [[nodiscard]] static Result<std::unique_ptr<Accounts>> open(const std::filesystem::path& folder,
                                                              Clock clock = nullptr);
  /// The user's default folder: `rave/gui` in XDG_STATE_HOME or ~/.local/state.
  [[nodiscard]] static std::filesystem::path usual_folder();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  /// Reads changes of other processes; fast if there are none. Errors: kIo, kParse; the previous
  /// state is kept then.
  [[nodiscard]] Status refresh();
  [[nodiscard]] AccountsFile state() const;
  /// Changes whenever the file changes. Fast.
  [[nodiscard]] std::uint64_t revision() const;

  // The following functions return after the file is written. Errors of all: kIo, kParse (the
  // file), and as named.

  /// Adds an account; the name is given, whatever `person` says. Errors: kInvalidArgument (an
  /// invalid name, one that differs from another only in case, or an invalid password).
  [[nodiscard]] Status add(const Person& person, std::string_view password);
  /// Removes an account and ends its sessions. Error kNotFound, with the nearest name.
  [[nodiscard]] Status remove(std::string_view name);
  /// Creates an invitation and returns the secret of its link. `name`: the person whom it is for,
  /// who gets this name and no other; empty: each person chooses one. Error kInvalidArgument unless
  /// `uses` is 1 to 1000, with a name 1, and `days` 1 to 365, and for a name that is taken.
  [[nodiscard]] Result<std::string> invite(Role role, const Teams& teams, int uses, int days,
                                           std::string_view by, std::string_view name = {});
  /// Lets a person keep the name that they chose, as if it had been given (Person::name_given).
  /// Error kNotFound.
  [[nodiscard]] Status give_name(std::string_view name);
  /// Changes the role and teams of an account. Errors: kNotFound; kState: no super-user who can
  /// sign in would be left.
  [[nodiscard]] Status change_person(const Person& person);
  /// Makes a user the only commander of a team: others who are listed for it lose it, in
  /// invitations too, but not those who command all teams. Error kNotFound: there is no such user.
  [[nodiscard]] Status give_team(std::string_view team, std::string_view user);
  /// Disables an account, which ends its sessions, or enables it again. Errors: those of
  /// change_person().
  [[nodiscard]] Status set_disabled(std::string_view name, bool disabled);
  /// Ends the sessions of an account; returns their number. The account of a guest without a
  /// password is removed too. Error kNotFound.
  [[nodiscard]] Result<std::size_t> end_sessions(std::string_view name);
  /// Revokes the invitation with this id and returns it. Error kNotFound.
  [[nodiscard]] Result<Invitation> withdraw(std::string_view id);
  /// Records that a user was present until now. Does nothing if the last record is less than ten
  /// seconds old.
  [[nodiscard]] Status note_seen(std::string_view name);
  /// Revokes all invitations; returns their number.
  [[nodiscard]] Result<std::size_t> revoke_invitations();
  /// Creates an account by an invitation and begins a session, whose secret it returns. Without a
  /// password the account lasts as long as the session. `kept`: names that no invited person can
  /// choose, such as those that rights mention. Errors: kState (the invitation is unknown, used up
  /// or expired), kInvalidArgument (the name is invalid, taken, kept or too like such a one, or not
  /// that of the invitation).
  [[nodiscard]] Result<std::string> join(std::string_view secret, const std::string& name,
                                         std::string_view password, const NameSet& kept = {});
  /// Begins a session and returns its secret. Error kState: a wrong name or password (neither the
  /// message nor the duration reveals which), or a disabled account if both are right.
  [[nodiscard]] Result<std::string> sign_in(std::string_view name, std::string_view password);
  [[nodiscard]] Status sign_out(std::string_view session);
  /// The user of a session. Fast.
  [[nodiscard]] std::optional<Person> who(std::string_view session) const;
  /// Whether an account has this name. Fast.
  [[nodiscard]] bool has(std::string_view name) const;
  /// A valid invitation. Fast.
  [[nodiscard]] std::optional<Invitation> invitation(std::string_view secret) const;

 private:
  Accounts(std::filesystem::path folder, Clock clock);
  /// Reads, changes and writes the file under a lock against other processes.
  [[nodiscard]] Status change(const std::function<Status(AccountsFile&)>& how);
  [[nodiscard]] Status read_if_changed();
  [[nodiscard]] Status write(const AccountsFile& changed);

  std::filesystem::path folder_;
  Clock clock_;
  std::mutex file_mutex_;  ///< Held during disk access; locked before `mutex_`.
  /// Identifies the file that was read; the file is replaced, never written in place.
  std::string stamp_;
  mutable std::mutex mutex_;  ///< Guards `state_`; never held for long.
  AccountsFile state_;
  std::uint64_t revision_ = 0;  ///< Guarded by `mutex_`.
};

}  // namespace rave::gui_server
