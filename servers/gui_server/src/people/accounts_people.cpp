// SPDX-License-Identifier: Apache-2.0
// What super-users change about people.
#include <algorithm>

#include "rave/base/names.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {
namespace {

constexpr std::int64_t kSeenSpacing_s = 10;

Result<Account*> known_account(AccountsFile& file, std::string_view name) {
  std::vector<std::string_view> names;
  for (Account& account : file.accounts) {
    if (account.person.name == name) return &account;
    names.emplace_back(account.person.name);
  }
  const std::string_view near = nearest_name(name, names);
  return fail(ErrorCode::kNotFound, "there is no account `{}`{}", name,
              near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
}

/// Those who can come back by themselves.
auto super_users(const AccountsFile& file) {
  return std::ranges::count_if(file.accounts, [](const Account& account) {
    return account.person.role == Role::kSuperUser && !account.disabled &&
           !account.password.empty();
  });
}

void drop_sessions(AccountsFile& file, std::string_view name) {
  std::erase_if(file.sessions, [name](const auto& session) { return session.user == name; });
}

/// Changes one account; who could mend it is never taken away.
Status change_account(AccountsFile& file, std::string_view name,
                      const std::function<void(Account&)>& how) {
  RAVE_TRY_ASSIGN(Account* const account, known_account(file, name));
  const auto before = super_users(file);
  how(*account);
  if (before > 0 && super_users(file) == 0) {
    return fail(ErrorCode::kState, "`{}` is the last super-user who can sign in", name);
  }
  return {};
}

}  // namespace

Status Accounts::remove(std::string_view name) {
  return change([&](AccountsFile& file) -> Status {
    RAVE_TRY(known_account(file, name));
    std::erase_if(file.accounts, [&](const auto& known) { return known.person.name == name; });
    drop_sessions(file, name);
    return {};
  });
}

Status Accounts::change_person(const Person& person) {
  return change([&](AccountsFile& file) {
    return change_account(file, person.name, [&](Account& account) {
      account.person.role = person.role;
      account.person.teams = person.teams;
    });
  });
}

Status Accounts::give_team(std::string_view team, std::string_view user) {
  return change([&](AccountsFile& file) -> Status {
    bool found = false;
    const auto give = [&](std::string_view name, Role role, Teams& teams) {
      if (name == user) {
        found = true;
        if (!teams.all) teams.names.emplace(team);
      } else if (role == Role::kCommander && !teams.all) {
        teams.names.erase(std::string(team));
      }
    };
    for (Account& account : file.accounts) {
      give(account.person.name, account.person.role, account.person.teams);
    }
    for (Invitation& invitation : file.invitations) {
      give(invitation.name, invitation.role, invitation.teams);
    }
    if (found) return {};
    return fail(ErrorCode::kNotFound, "there is no account or invitation of `{}`", user);
  });
}

Status Accounts::give_name(std::string_view name) {
  return change([&](AccountsFile& file) -> Status {
    RAVE_TRY_ASSIGN(Account* const account, known_account(file, name));
    account->person.name_given = true;
    return {};
  });
}

Status Accounts::set_disabled(std::string_view name, bool disabled) {
  return change([&](AccountsFile& file) -> Status {
    RAVE_TRY(change_account(file, name, [&](Account& account) { account.disabled = disabled; }));
    if (disabled) drop_sessions(file, name);
    return {};
  });
}

Result<std::size_t> Accounts::end_sessions(std::string_view name) {
  std::size_t count = 0;
  const Status changed = change([&](AccountsFile& file) -> Status {
    RAVE_TRY(known_account(file, name));
    const std::size_t before = file.sessions.size();
    drop_sessions(file, name);
    count = before - file.sessions.size();
    return {};
  });
  RAVE_TRY(changed);
  return count;
}

Result<Invitation> Accounts::withdraw(std::string_view id) {
  Invitation withdrawn;
  RAVE_TRY(change([&](AccountsFile& file) -> Status {
    const auto found = std::ranges::find_if(
        file.invitations, [id](const Invitation& known) { return known.id() == id; });
    if (found == file.invitations.end()) {
      return fail(ErrorCode::kNotFound, "this invitation is used up, has expired or was withdrawn");
    }
    withdrawn = *found;
    file.invitations.erase(found);
    return {};
  }));
  return withdrawn;
}

Status Accounts::note_seen(std::string_view name) {
  const std::int64_t now_s = clock_();
  const auto is_due = [&](const Account& account) {
    return account.person.name == name && now_s - account.seen_s >= kSeenSpacing_s;
  };
  // Most pages that go are loaded again at once.
  if (std::ranges::none_of(state().accounts, is_due)) return {};
  return change([&](AccountsFile& file) -> Status {
    for (Account& account : file.accounts) {
      if (is_due(account)) account.seen_s = now_s;
    }
    return {};
  });
}

Result<std::size_t> Accounts::revoke_invitations() {
  std::size_t count = 0;
  RAVE_TRY(change([&](AccountsFile& file) -> Status {
    count = file.invitations.size();
    file.invitations.clear();
    return {};
  }));
  return count;
}

}  // namespace rave::gui_server
