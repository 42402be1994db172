// SPDX-License-Identifier: Apache-2.0
#include "run_people.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string_view>

#include "error_text.hpp"
#include "rave/base/number.hpp"
#include "rave/control/folder.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::cli {
namespace {

using gui_server::Accounts;
using gui_server::Role;

Role role_of(config::UserRole role) {
  switch (role) {
    case config::UserRole::kObserver:
      return Role::kObserver;
    case config::UserRole::kCommander:
      return Role::kCommander;
    case config::UserRole::kSuperUser:
      break;
  }
  return Role::kSuperUser;
}

constexpr std::string_view kFolderPrefix = "people-";

/// Removes the folders of processes that were killed, which could not do so.
void remove_left_folders(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kFolderPrefix)) continue;
    const std::string_view rest = std::string_view(name).substr(kFolderPrefix.size());
    const auto process = number_of<pid_t>(rest.substr(0, rest.find('-')));
    std::error_code ignored;
    const bool gone = process && *process > 0 && ::kill(*process, 0) != 0 && errno == ESRCH;
    if (gone) std::filesystem::remove_all(entry->path(), ignored);
  }
}

Result<std::filesystem::path> temporary_folder() {
  RAVE_TRY_ASSIGN(const auto folder, control::socket_folder());
  remove_left_folders(folder);
  std::string name = folder / fmt::format("{}{}-XXXXXX", kFolderPrefix, ::getpid());
  if (::mkdtemp(name.data()) != nullptr) return name;
  return fail(ErrorCode::kIo, "cannot create a folder in `{}`", folder.string());
}

std::string teams_text(const gui_server::Teams& teams) {
  if (teams.all) return "all teams";
  if (teams.names.empty()) return "no team";
  return fmt::format("{} {}", teams.names.size() == 1 ? "team" : "teams",
                     fmt::join(teams.names, ", "));
}

}  // namespace

Result<std::unique_ptr<RunPeople>> RunPeople::of(const config::ExpandedScenario& scenario,
                                                 PageOptions& page) {
  std::unique_ptr<RunPeople> people(new RunPeople);
  people->people_ = config::plan_people(scenario);
  if (people->people_.empty()) return people;
  RAVE_TRY(people->find_accounts(page));
  return people;
}

Result<std::unique_ptr<RunPeople>> RunPeople::of_page(PageOptions& page) {
  std::unique_ptr<RunPeople> people(new RunPeople);
  RAVE_TRY(people->find_accounts(page));
  return people;
}

Status RunPeople::find_accounts(PageOptions& page) {
  if (page.accounts.empty() && page.listen == gui_server::GuiOptions().listen) {
    RAVE_TRY_ASSIGN(temporary_, temporary_folder());
    page.accounts = temporary_;
  }
  if (page.accounts.empty()) page.accounts = Accounts::usual_folder();
  accounts_ = page.accounts;
  return {};
}

RunPeople::~RunPeople() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove_all(temporary_, ignored);
}

Status RunPeople::invite(gui_server::GuiServer& server) const {
  if (people_.empty()) return {};
  RAVE_TRY_ASSIGN(const auto accounts, Accounts::open(accounts_));
  const std::string entry = server.entry();
  const std::string origin = entry.substr(0, entry.rfind('/'));
  std::size_t width = 0;
  for (const auto& person : people_) width = std::max(width, person.name.size());
  for (const config::PlannedPerson& person : people_) {
    const Role role = role_of(person.role);
    gui_server::Teams teams{.all = !person.teams, .names = {}};
    if (person.teams) teams.names = *person.teams;
    const std::string what = fmt::format("{}, {}", to_string(role), teams_text(teams));
    if (accounts->has(person.name)) {
      put(stdout, fmt::format("{:{}}  {}  (has an account, whose rights count)\n", person.name,
                              width, origin));
      continue;
    }
    RAVE_TRY_ASSIGN(const std::string secret,
                    accounts->invite(role, teams, 1, 1, "scenario", person.name));
    put(stdout,
        fmt::format("{:{}}  {}/join?invite={}  ({})\n", person.name, width, origin, secret, what));
  }
  std::fflush(stdout);
  return {};
}

}  // namespace rave::cli
