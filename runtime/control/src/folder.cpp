// SPDX-License-Identifier: Apache-2.0
#include "rave/control/folder.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "rave/base/names.hpp"
#include "rave/process/unix_socket.hpp"

namespace rave::control {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".sock";
/// Because sockaddr_un holds a path of at most 107 bytes (unix(7)).
constexpr std::size_t kMaxScenarioBytes = 40;

fs::path wanted_folder() {
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime != nullptr && runtime[0] == '/') return fs::path(runtime) / "rave";
  // Not TMPDIR: all terminals must use the same folder.
  return fmt::format("{}/rave-{}", P_tmpdir, ::geteuid());
}

/// Separates the scenario from the host that runs a part of it.
constexpr char kOfHost = '@';

/// The part of the name before the process id.
std::string_view scenario_of(std::string_view run) { return run.substr(0, run.rfind('-')); }
std::string_view process_of(std::string_view run) { return run.substr(run.rfind('-') + 1); }

}  // namespace

Result<fs::path> socket_folder() {
  const fs::path folder = wanted_folder();
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}", folder.string(),
                std::strerror(errno));
  }
  struct stat info {};
  if (::lstat(folder.c_str(), &info) != 0) {
    return fail(ErrorCode::kIo, "cannot read the state of `{}`: {}", folder.string(),
                std::strerror(errno));
  }
  // Any user can create a folder in /tmp, so check that this one is ours and private.
  if (!S_ISDIR(info.st_mode) || info.st_uid != ::geteuid() || (info.st_mode & 077U) != 0) {
    return fail(ErrorCode::kState,
                "`{}` must be a folder of this user with mode 0700, and not a link",
                folder.string());
  }
  return folder;
}

std::string own_run_name(std::string_view scenario, std::string_view host) {
  if (host.empty()) {
    return fmt::format("{}-{}", scenario.substr(0, kMaxScenarioBytes), ::getpid());
  }
  constexpr std::size_t kMaxHostBytes = 20;
  return fmt::format("{}{}{}-{}", scenario.substr(0, kMaxScenarioBytes - kMaxHostBytes), kOfHost,
                     host.substr(0, kMaxHostBytes), ::getpid());
}

Result<std::vector<std::string>> running_runs() {
  RAVE_TRY_ASSIGN(const fs::path folder, socket_folder());
  std::vector<std::string> runs;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename();
    if (!name.ends_with(kEnding) || !entry.is_socket(error)) continue;
    const auto connection = process::connect_to(entry.path());
    if (connection) {
      runs.push_back(name.substr(0, name.size() - kEnding.size()));
    } else if (connection.error().code == ErrorCode::kNotFound) {
      fs::remove(entry.path(), error);
    }
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

Result<std::string> find_run(std::string_view word) {
  RAVE_TRY_ASSIGN(const std::vector<std::string> runs, running_runs());
  if (runs.empty()) return fail(ErrorCode::kNotFound, "no run is in progress");
  std::vector<std::string_view> names;
  for (const std::string& run : runs) {
    if (run.find(kOfHost) == std::string::npos) names.emplace_back(run);
  }
  if (names.empty()) names.assign(runs.begin(), runs.end());
  if (word.empty() && names.size() == 1) return std::string(names.front());
  if (word.empty()) {
    return fail(ErrorCode::kNotFound, "{} runs are in progress: {}", names.size(),
                choose_one(names));
  }
  std::vector<std::string> of_scenario;
  for (const std::string& run : runs) {
    if (run == word || process_of(run) == word) return run;
    if (scenario_of(run) == word) of_scenario.push_back(run);
  }
  if (of_scenario.size() == 1) return of_scenario.front();
  if (of_scenario.size() > 1) {
    names.assign(of_scenario.begin(), of_scenario.end());
    return fail(ErrorCode::kNotFound, "several runs match `{}`: {}", word, choose_one(names));
  }
  names.assign(runs.begin(), runs.end());
  return fail(ErrorCode::kNotFound, "there is no run `{}`{}", word, suggestion(word, names));
}

std::string choose_one(std::span<const std::string_view> runs, std::string_view option) {
  return fmt::format("{}; name one, by its name or process id, such as `{}{}{}`", join_names(runs),
                     option, option.empty() ? "" : " ", process_of(runs.front()));
}

}  // namespace rave::control
