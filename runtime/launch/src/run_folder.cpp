// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/run_folder.hpp"

#include <array>
#include <ctime>
#include <optional>

#include "rave/base/file.hpp"
#include "rave/results/facts_file.hpp"

namespace rave::launch {
namespace {

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm fields{};
  ::localtime_r(&now, &fields);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &fields);
  return text;
}

namespace fs = std::filesystem;

/// What a run leaves, beside the folder `hosts` with the same of each host.
constexpr std::array<std::string_view, 10> kRunFiles = {
    "run.mcap",    "world.mcap",  "result.json", "summary.txt",   "events.log",
    "picture.svg", "picture.png", "console.log", "scenario.yaml", runtime::kFactsFile};

/// The keys of its direct lines, which a run of several processes makes.
constexpr std::array<std::string_view, 2> kLineKeys = {"line_key", "line_key.pub"};

/// A file of an earlier run, or the records of its hosts, which would be taken for those of the
/// new.
std::optional<std::string> trace_of_run(const fs::path& folder) {
  std::error_code error;
  for (const std::string_view file : kRunFiles) {
    if (fs::exists(folder / file, error)) return std::string(file);
  }
  if (fs::exists(folder / "companions", error)) return "companions";
  if (fs::exists(folder / "maps", error)) return "maps";
  if (!fs::exists(folder / "hosts", error)) return std::nullopt;
  // What keeps it there says more.
  for (const auto& entry : fs::recursive_directory_iterator(folder / "hosts", error)) {
    if (!entry.is_directory(error)) return entry.path().lexically_relative(folder).string();
  }
  return "hosts";
}

/// Removes what a run left, and the reports on it; what else lies there stays.
void remove_run(const fs::path& folder, std::error_code& error) {
  for (const std::string_view file : kRunFiles) {
    fs::remove(folder / file, error);
    if (error) return;
  }
  std::error_code ended;
  const bool shared = fs::exists(folder / "hosts", ended);
  for (const std::string_view key : kLineKeys) {
    if (shared) fs::remove(folder / key, error);
    if (error) return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ended)) {
    if (entry.path().filename().string().starts_with("gap-")) fs::remove(entry.path(), error);
    if (error) return;
  }
  for (const fs::directory_entry& host : fs::directory_iterator(folder / "hosts", ended)) {
    remove_run(host.path(), error);
    if (error) return;
    fs::remove(host.path(), ended);  // stays if something else is in it
  }
  fs::remove(folder / "hosts", ended);
  // All of it is theirs.
  fs::remove_all(folder / "companions", ended);
  fs::remove_all(folder / "maps", ended);
}

/// The expanded scenario is written as `scenario.yaml`, which is also the usual name of what people
/// write themselves.
Status check_no_input(const WantedFolder& wanted) {
  std::error_code error;
  for (const std::string_view file : kRunFiles) {
    const fs::path path = wanted.path / file;
    if (wanted.scenario_file.empty() || !fs::equivalent(path, wanted.scenario_file, error)) {
      continue;
    }
    return fail(ErrorCode::kInvalidArgument,
                "`{}` is the scenario that you run, and results would replace it; choose another "
                "folder with --output",
                path.string());
  }
  return {};
}

}  // namespace

Result<RunFolder> RunFolder::create(const WantedFolder& wanted, std::string_view scenario) {
  const fs::path& given = wanted.path;
  std::error_code error;
  RunFolder folder;
  if (!given.empty()) {
    RAVE_TRY(check_no_input(wanted));
    folder.path_ = given;
    folder.is_new_ = !fs::exists(given, error);
    RAVE_TRY(create_folder(given));
    if (wanted.replace) remove_run(given, error);
    if (error) {
      return fail(ErrorCode::kIo, "cannot remove the earlier run in `{}`: {}", given.string(),
                  error.message());
    }
    if (const auto trace = trace_of_run(given)) {
      return fail(
          ErrorCode::kInvalidArgument,
          "the folder `{}` has the results of another run (`{}`); choose another folder with "
          "--output{}",
          given.string(), *trace, wanted.replace ? "" : ", or remove those results with --replace");
    }
    return folder;
  }
  fs::create_directories("runs", error);
  const std::string stem = fmt::format("runs/{}-{}", local_time(), scenario);
  for (int number = 1; !error && !folder.is_new_; ++number) {
    folder.path_ = number == 1 ? stem : fmt::format("{}-{}", stem, number);
    folder.is_new_ = fs::create_directory(folder.path_, error);
  }
  if (error) {
    return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}; choose another with --output",
                stem, error.message());
  }
  return folder;
}

void RunFolder::discard() const {
  std::error_code ignored;
  if (is_new_) {
    fs::remove_all(path_, ignored);
  } else {
    remove_run(path_, ignored);
  }
}

}  // namespace rave::launch
