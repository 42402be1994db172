// SPDX-License-Identifier: Apache-2.0
#include "places.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "error_text.hpp"
#include "rave/base/names.hpp"
#include "rave/launch/plugin_folders.hpp"
#include "rave/record/merge.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;

/// A kind of file that comes with RAVE and is found by name.
struct NamedKind {
  std::string_view noun;
  std::string_view folder;  ///< Of the current and the share folder.
  std::string_view file;    ///< In the folder of one.
};
constexpr NamedKind kScenarios{"scenario", "scenarios", "scenario.yaml"};
constexpr NamedKind kExperiments{"experiment", "experiments", "experiment.yaml"};

/// Where files are looked up by name. Those of the share folder by their real place, because the
/// files they name are relative to it.
std::vector<fs::path> folders_of(const NamedKind& kind) {
  std::error_code error;
  std::vector<fs::path> folders = {kind.folder};
  const fs::path shared = fs::canonical(share_folder() / kind.folder, error);
  if (!error) folders.push_back(shared);
  return folders;
}

std::optional<fs::path> file_in(const fs::path& folder, const fs::path& name,
                                const NamedKind& kind) {
  std::error_code error;
  fs::path yaml = folder / name;
  yaml += ".yaml";
  for (const fs::path& path : {folder / name / kind.file, yaml, folder / name}) {
    if (fs::is_regular_file(path, error)) return path;
  }
  return std::nullopt;
}

std::vector<std::string> names_in(const std::vector<fs::path>& folders, const NamedKind& kind) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::path& folder : folders) {
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const fs::path& path = entry->path();
      std::error_code ignored;
      if (fs::is_regular_file(path / kind.file, ignored)) {
        names.push_back(path.filename().string());
      } else if (path.extension() == ".yaml") {
        names.push_back(path.stem().string());
      }
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Result<fs::path> find_named(std::string_view word, const NamedKind& kind) {
  const fs::path path(word);
  std::error_code error;
  if (fs::is_directory(path, error)) {
    if (fs::is_regular_file(path / kind.file, error)) return path / kind.file;
  } else if (fs::exists(path, error)) {
    return path;
  }
  // `corridor/simulated` names another file of a shipped scenario.
  if (!word.empty() && path.is_relative() && !word.starts_with('.')) {
    for (const fs::path& folder : folders_of(kind)) {
      if (auto found = file_in(folder, path, kind)) return *std::move(found);
    }
  }
  if (fs::is_directory(path, error)) {
    return fail(ErrorCode::kNotFound, "the folder `{}` has no {}", word, kind.file);
  }
  const std::vector<std::string> names = names_in(folders_of(kind), kind);
  const std::vector<std::string_view> views(names.begin(), names.end());
  return fail(
      ErrorCode::kNotFound,
      "there is no {} `{}`: not a file, not a folder, and not a name in `{}` of this folder or of "
      "`{}`{}",
      kind.noun, word, kind.folder, share_folder().string(), suggestion(word, views));
}

}  // namespace

fs::path executable_folder() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

fs::path share_folder() {
  const char* const given = std::getenv("RAVE_SHARE");
  if (given != nullptr && *given != '\0') return given;
  return executable_folder().parent_path() / "share" / "rave";
}

std::vector<std::string> shipped_scenarios() {
  return names_in({share_folder() / kScenarios.folder}, kScenarios);
}

std::vector<std::string> known_scenarios() { return names_in(folders_of(kScenarios), kScenarios); }

fs::path program_runner() { return executable_folder() / "rave-program-runner"; }

Result<fs::path> record_file(std::string_view word) {
  RAVE_TRY_ASSIGN(auto run, record::open_run(word));
  for (const std::string& note : run.notes) put_note(terminal_of(stderr).yellow("missing:"), note);
  return std::move(run.file);
}

Result<std::unique_ptr<plugin::Catalogue>> open_catalogue(const std::vector<std::string>& given) {
  return launch::open_catalogue(given, executable_folder() / "rave");
}

Result<fs::path> find_scenario(std::string_view word) { return find_named(word, kScenarios); }

Result<fs::path> find_experiment(std::string_view word) { return find_named(word, kExperiments); }

}  // namespace rave::cli
