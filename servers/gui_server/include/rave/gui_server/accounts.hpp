// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/gui_server/person.hpp"

// Who may come in, as the file `accounts` of a private folder. Passwords are kept as Argon2id;
// secrets of links and sessions, which are random, as a plain hash. Moments are seconds since 1970.
namespace rave::gui_server {

struct Account {
  Person person;
  std::string password;     ///< As libsodium writes it; empty: came in by a link and has none.
  bool disabled = false;    ///< Keeps the name and cannot come in.
  std::int64_t seen_s = 0;  ///< When their last page went, or they came in; 0: never.
};

struct Invitation {
  std::string hash;
  Role role = Role::kObserver;
  Teams teams;
  int uses = 1;  ///< That are left.
  std::int64_t until_s = 0;
  std::string by;  ///< Who made it.

  /// Names it to people. Nobody can reckon the secret from it.
  [[nodiscard]] std::string id() const { return hash.substr(0, 16); }
};

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

/// Reads the file. Strict: error kParse at the line of whatever it does not know. Sessions of
/// nobody, as they are left by a line that was removed by hand, are dropped.
[[nodiscard]] Result<AccountsFile> parse_accounts(std::string_view text,
                                                  std::string_view file_name);
[[nodiscard]] std::string write_accounts(const AccountsFile& accounts);

/// Whether somebody can have that name: 1 to 32 letters, digits, `-`, `_`, `.` and `@`, the first a
/// letter or digit. Error kInvalidArgument.
[[nodiscard]] Status check_user_name(std::string_view name);
/// Whether it is long enough (10 characters) and not absurdly long. Error kInvalidArgument.
[[nodiscard]] Status check_password(std::string_view password);

/// The accounts of a server. Any thread; several processes may use the same folder. add(), join()
/// and sign_in() take a tenth of a second for the password, so they are nothing for the thread of a
/// server.
class Accounts {
 public:
  using Clock = std::function<std::int64_t()>;
  static constexpr std::int64_t kSessionLife_s = 7 * 86'400;

  /// Makes the folder (0700) if it is missing. Errors: kState (others can read it), kIo, kParse.
  /// `clock`: null for the one on the wall.
  [[nodiscard]] static Result<std::unique_ptr<Accounts>> open(const std::filesystem::path& folder,
                                                              Clock clock = nullptr);
  /// The user's own: `rave/gui` in XDG_STATE_HOME or ~/.local/state.
  [[nodiscard]] static std::filesystem::path usual_folder();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  /// Takes in what another process has written; quick if nothing was. Errors: kIo, kParse; then
  /// what was known stays.
  [[nodiscard]] Status refresh();
  [[nodiscard]] AccountsFile state() const;
  /// Another number whenever the file is another. Quick.
  [[nodiscard]] std::uint64_t revision() const;

  // Each is in the file when it returns. Errors of all: kIo, kParse (the file), and as named.

  /// Errors: kInvalidArgument (the name, also if it differs in capitals alone, or the password).
  [[nodiscard]] Status add(const Person& person, std::string_view password);
  /// Ends the sessions too. Error kNotFound, with the nearest name.
  [[nodiscard]] Status remove(std::string_view name);
  /// The secret of a link. `uses` 1 to 1000, `days` 1 to 365; else error kInvalidArgument.
  [[nodiscard]] Result<std::string> invite(Role role, const Teams& teams, int uses, int days,
                                           std::string_view by);
  /// Gives somebody another role and other teams. Errors: kNotFound; kState: no super-user who can
  /// sign in would be left.
  [[nodiscard]] Status change_person(const Person& person);
  /// Disables an account, which ends its sessions, or enables it again. Errors: as change_person().
  [[nodiscard]] Status set_disabled(std::string_view name, bool disabled);
  /// How many there were. A guest without a password goes with them. Error kNotFound.
  [[nodiscard]] Result<std::size_t> end_sessions(std::string_view name);
  /// Takes back the invitation of an id and returns what it was. Error kNotFound.
  [[nodiscard]] Result<Invitation> withdraw(std::string_view id);
  /// Somebody was here until now. Writes nothing if that was told within ten seconds.
  [[nodiscard]] Status note_seen(std::string_view name);
  /// Takes back all invitations; how many there were.
  [[nodiscard]] Result<std::size_t> revoke_invitations();
  /// Makes an account by an invitation and begins a session, whose secret it returns. Without a
  /// password the account lasts as long as the session. Errors: kState (the invitation is not
  /// known, used up or too old), kInvalidArgument.
  [[nodiscard]] Result<std::string> join(std::string_view secret, const std::string& name,
                                         std::string_view password);
  /// Begins a session and returns its secret. Error kState: the name or the password is wrong;
  /// which of them, neither the text nor the time says; or both are right and the account is
  /// disabled.
  [[nodiscard]] Result<std::string> sign_in(std::string_view name, std::string_view password);
  [[nodiscard]] Status sign_out(std::string_view session);
  /// Whose session it is. Quick.
  [[nodiscard]] std::optional<Person> who(std::string_view session) const;
  /// Whether somebody is called so. Quick.
  [[nodiscard]] bool has(std::string_view name) const;
  /// Whether an invitation can be used. Quick.
  [[nodiscard]] bool knows_invitation(std::string_view secret) const;

 private:
  Accounts(std::filesystem::path folder, Clock clock);
  /// Reads, changes and writes while no other process does.
  [[nodiscard]] Status change(const std::function<Status(AccountsFile&)>& how);
  [[nodiscard]] Status read_if_changed();
  [[nodiscard]] Status write(const AccountsFile& changed);

  std::filesystem::path folder_;
  Clock clock_;
  std::mutex file_mutex_;     ///< Held while the disk is waited for; taken before `mutex_`.
  std::string stamp_;         ///< Of the file that was read: it is never written in place.
  mutable std::mutex mutex_;  ///< Of `state_`; never held for long.
  AccountsFile state_;
  std::uint64_t revision_ = 0;  ///< Guarded by `mutex_`.
};

}  // namespace rave::gui_server
