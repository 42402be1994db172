// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/accounts.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "people/free_name.hpp"
#include "people/secrets.hpp"
#include "rave/base/descriptor.hpp"
#include "rave/base/file.hpp"
#include "rave/base/wall_clock.hpp"

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile = std::size_t{8} << 20U;
constexpr std::size_t kMostInvitations = 1000;
constexpr std::ptrdiff_t kSessionsOfOne = 20;

/// A lock that is held while a process reads, changes and writes. Ends with the process, however
/// that ends.
Result<Descriptor> lock_file(const fs::path& file) {
  Descriptor lock(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  // flock() and not a lock file that is created and removed: that one would stay after a crash.
  if (!lock || ::flock(lock.get(), LOCK_EX) != 0) {
    return fail(ErrorCode::kIo, "cannot lock `{}`: {}", file.string(), std::strerror(errno));
  }
  return lock;
}

std::int64_t wall_s() { return wall_ns() / kSecond_ns; }

auto account_of(auto& file, std::string_view name) {
  return std::ranges::find_if(
      file.accounts, [name](const Account& account) { return account.person.name == name; });
}

/// What has ended is not kept; with the last session of a guest goes the guest.
void tidy(AccountsFile& file, std::int64_t now_s) {
  std::erase_if(file.sessions, [now_s](const auto& session) { return session.until_s <= now_s; });
  std::erase_if(file.invitations, [now_s](const Invitation& invitation) {
    return invitation.until_s <= now_s || invitation.uses <= 0;
  });
  std::erase_if(file.accounts, [&](const Account& account) {
    return account.password.empty() && !account.disabled &&
           std::ranges::none_of(file.sessions, [&](const SessionEntry& session) {
             return session.user == account.person.name;
           });
  });
}

/// Begins a session; of too many of one user the oldest ends.
std::string begin_session(AccountsFile& file, const std::string& user, std::int64_t until_s) {
  const auto is_theirs = [&user](const SessionEntry& session) { return session.user == user; };
  if (std::ranges::count_if(file.sessions, is_theirs) >= kSessionsOfOne) {
    // New ones are added at the end, so the first is the oldest.
    file.sessions.erase(std::ranges::find_if(file.sessions, is_theirs));
  }
  std::string secret = new_secret();
  // Of secrets the file has hashes alone: who reads it can use none of them.
  file.sessions.push_back({hash_of(secret), user, until_s});
  return secret;
}

Result<std::string> hashed(std::string_view password) {
  std::string hash = password_hash(password);
  if (hash.empty()) return fail(ErrorCode::kIo, "there is not enough memory for a password");
  return hash;
}

}  // namespace

Accounts::Accounts(fs::path folder, Clock clock)
    : folder_(std::move(folder)), clock_(clock ? std::move(clock) : Clock(wall_s)) {}

fs::path Accounts::usual_folder() {
  const char* const state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return fs::path(state) / "rave/gui";
  const char* const home = std::getenv("HOME");
  return fs::path(home == nullptr ? "." : home) / ".local/state/rave/gui";
}

Result<std::unique_ptr<Accounts>> Accounts::open(const fs::path& folder, Clock clock) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    fs::create_directories(folder.parent_path(), error);
    // Not by create_directories(): others could read the folder until its permissions are set.
    if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
      return fail(ErrorCode::kIo, "cannot make the folder `{}`: {}", folder.string(),
                  std::strerror(errno));
    }
  }
  struct stat info {};
  if (::stat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode)) {
    return fail(ErrorCode::kIo, "`{}` is not a folder", folder.string());
  }
  if ((info.st_mode & 077U) != 0) {
    return fail(ErrorCode::kState,
                "other users can read the folder of accounts `{0}`: chmod 700 {0}",
                folder.string());
  }
  std::unique_ptr<Accounts> accounts(new Accounts(folder, std::move(clock)));
  RAVE_TRY(accounts->refresh());
  return accounts;
}

Status Accounts::read_if_changed() {
  const fs::path file = folder_ / "accounts";
  struct stat info {};
  AccountsFile known;
  std::string stamp;
  if (::stat(file.c_str(), &info) == 0) {
    // With the inode, because an atomic write replaces the file: a change is noticed even if size
    // and time are equal.
    stamp = fmt::format("{} {} {} {}", info.st_ino, info.st_size, info.st_mtim.tv_sec,
                        info.st_mtim.tv_nsec);
    if (stamp == stamp_) return {};
    RAVE_TRY_ASSIGN(const std::string text, read_file(file, kLargestFile));
    RAVE_TRY_ASSIGN(known, parse_accounts(text, file.string()));
  } else if (errno != ENOENT) {
    return fail(ErrorCode::kIo, "cannot read `{}`: {}", file.string(), std::strerror(errno));
  }
  stamp_ = std::move(stamp);
  const std::lock_guard lock(mutex_);
  state_ = std::move(known);
  ++revision_;
  return {};
}

Status Accounts::refresh() {
  // Who holds it reads the file anyway; a server's thread does not wait for a disk.
  const std::unique_lock lock(file_mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return {};
  return read_if_changed();
}

Status Accounts::change(const std::function<Status(AccountsFile&)>& how) {
  const std::lock_guard lock(file_mutex_);
  RAVE_TRY_ASSIGN(const Descriptor file_lock, lock_file(folder_ / "lock"));
  // Under the lock, since another process may have changed the file.
  RAVE_TRY(read_if_changed());
  // A copy: if `how` or the write fails, the state in memory is still that of the file.
  AccountsFile changed = state();
  RAVE_TRY(how(changed));
  return write(changed);
}

Status Accounts::write(const AccountsFile& changed) {
  RAVE_TRY(write_private_file_atomically(folder_ / "accounts", write_accounts(changed)));
  // Read back what was written, so that memory and file cannot differ.
  stamp_.clear();
  return read_if_changed();
}

AccountsFile Accounts::state() const {
  const std::lock_guard lock(mutex_);
  AccountsFile state = state_;
  // The copy alone: what has expired must not count, but reading does not write.
  tidy(state, clock_());
  return state;
}

std::uint64_t Accounts::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

Status Accounts::add(const Person& person, std::string_view password) {
  RAVE_TRY(check_user_name(person.name));
  RAVE_TRY(check_password(password));
  RAVE_TRY_ASSIGN(const std::string hash, hashed(password));
  return change([&](AccountsFile& file) -> Status {
    RAVE_TRY(check_free(file, person.name));
    file.accounts.push_back({person, hash, false, 0});
    file.accounts.back().person.name_given = true;
    return {};
  });
}

Result<std::string> Accounts::invite(Role role, const Teams& teams, int uses, int days,
                                     std::string_view by, std::string_view name) {
  if (!name.empty()) RAVE_TRY(check_user_name(name));
  if (!name.empty() && uses != 1) {
    return fail(ErrorCode::kInvalidArgument, "an invitation for `{}` is for one person", name);
  }
  if (uses < 1 || uses > 1000) {
    return fail(ErrorCode::kInvalidArgument, "an invitation is valid for 1 to 1000 people");
  }
  if (days < 1 || days > 365) {
    return fail(ErrorCode::kInvalidArgument, "an invitation is valid for 1 to 365 days");
  }
  RAVE_TRY(check_user_name(by));
  std::string secret = new_secret();
  const auto make = [&](AccountsFile& file) -> Status {
    if (file.invitations.size() >= kMostInvitations) {
      return fail(ErrorCode::kState, "there are already {} invitations, which is the maximum",
                  kMostInvitations);
    }
    if (!name.empty()) RAVE_TRY(check_free(file, name));
    const std::int64_t until_s = clock_() + std::int64_t{86'400} * days;
    file.invitations.push_back(
        {hash_of(secret), role, teams, uses, until_s, std::string(by), std::string(name)});
    return {};
  };
  RAVE_TRY(change(make));
  return secret;
}

Result<std::string> Accounts::join(std::string_view secret, const std::string& name,
                                   std::string_view password, const NameSet& kept) {
  constexpr const char* kUnknown =
      "this invitation is used up, has expired, or is not from this server";
  RAVE_TRY(check_user_name(name));
  RAVE_TRY(refresh());
  // A guess does not cause slow work.
  if (!invitation(secret)) return fail(ErrorCode::kState, "{}", kUnknown);
  std::string hash;
  if (!password.empty()) {
    RAVE_TRY(check_password(password));
    RAVE_TRY_ASSIGN(hash, hashed(password));
  }
  std::string session;
  const auto take = [&](AccountsFile& file) -> Status {
    const auto found = std::ranges::find(file.invitations, hash_of(secret), &Invitation::hash);
    if (found == file.invitations.end()) return fail(ErrorCode::kState, "{}", kUnknown);
    const bool given = !found->name.empty();
    if (given && found->name != name) {
      return fail(ErrorCode::kInvalidArgument, "this invitation is for `{}`", found->name);
    }
    RAVE_TRY(given ? check_free(file, name) : check_chosen(file, name, kept));
    file.accounts.push_back({{name, found->role, found->teams, given}, hash, false, clock_()});
    // Account, uses and session change in one write: a crash cannot use up an invitation without an
    // account.
    --found->uses;
    session = begin_session(file, name, clock_() + kSessionLife_s);
    return {};
  };
  RAVE_TRY(change(take));
  return session;
}

Result<std::string> Accounts::sign_in(std::string_view name, std::string_view password) {
  std::string hash;
  RAVE_TRY(refresh());
  {
    const std::lock_guard lock(mutex_);
    const auto found = account_of(state_, name);
    if (found != state_.accounts.end()) hash = found->password;
  }
  const auto wrong = fail(ErrorCode::kState, "the name or the password is wrong");
  // Outside of the locks: Argon2id is slow on purpose, and other people sign in meanwhile.
  if (!password_fits(password, hash)) return wrong;
  std::string session;
  RAVE_TRY(change([&](AccountsFile& file) -> Status {
    const auto found = account_of(file, name);
    // It may have been removed or given another password meanwhile.
    if (found == file.accounts.end() || found->password != hash) return wrong;
    if (found->disabled) {
      return fail(ErrorCode::kState, "this account is disabled; a super-user can enable it");
    }
    found->seen_s = clock_();
    session = begin_session(file, found->person.name, clock_() + kSessionLife_s);
    return {};
  }));
  return session;
}

Status Accounts::sign_out(std::string_view session) {
  return change([&](AccountsFile& file) -> Status {
    std::erase_if(file.sessions,
                  [hash = hash_of(session)](const auto& entry) { return entry.hash == hash; });
    return {};
  });
}

std::optional<Person> Accounts::who(std::string_view session) const {
  if (session.empty()) return std::nullopt;
  const std::string hash = hash_of(session);
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(state_.sessions, hash, &SessionEntry::hash);
  if (found == state_.sessions.end() || found->until_s <= clock_()) return std::nullopt;
  const auto account = account_of(state_, found->user);
  if (account == state_.accounts.end() || account->disabled) return std::nullopt;
  return account->person;
}

bool Accounts::has(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  return account_of(state_, name) != state_.accounts.end();
}

std::optional<Invitation> Accounts::invitation(std::string_view secret) const {
  const std::string hash = hash_of(secret);
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(state_.invitations, hash, &Invitation::hash);
  const bool valid =
      found != state_.invitations.end() && found->uses > 0 && found->until_s > clock_();
  return valid ? std::optional(*found) : std::nullopt;
}

}  // namespace rave::gui_server
