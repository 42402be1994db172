// SPDX-License-Identifier: Apache-2.0
#include "replay/kept_recordings.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "rave/base/control_characters.hpp"
#include "rave/record/merge.hpp"

namespace rave::gui_server {
namespace {

namespace fs = std::filesystem;

/// More places do not help anybody.
constexpr std::size_t kMostPlaces = 6;

/// A folder for a merged recording, removed with the source that plays it.
struct Scratch {
  fs::path path;
  std::shared_ptr<Source> source;

  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    source.reset();
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
};

bool readable(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && std::ifstream(file).good();
}

/// Where one folder has the recordings of all: that of the manager who started the hosts.
const fs::path* common_folder(std::span<const watch::KeptAt> kept, fs::path& place) {
  if (kept.empty() || !kept.front().manager) return nullptr;
  place = kept.front().folder;
  const bool all = std::ranges::all_of(kept, [&](const watch::KeptAt& one) {
    return one.manager || fs::path(one.folder).parent_path() == place / "hosts";
  });
  return all ? &place : nullptr;
}

Result<std::shared_ptr<Source>> merge(std::vector<fs::path> parts) {
  if (parts.size() == 1) return open_recording(parts.front());
  auto scratch = std::make_shared<Scratch>();
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "rave-gui-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) {
    return fail(ErrorCode::kIo, "cannot create a temporary folder `{}`", name);
  }
  scratch->path = name;
  const fs::path merged = scratch->path / "run.mcap";
  RAVE_TRY(record::merge_records(parts, merged));
  RAVE_TRY_ASSIGN(scratch->source, open_recording(merged));
  Source* const source = scratch->source.get();
  // Shared by all who play it; the folder goes with the last of them.
  return std::shared_ptr<Source>(std::move(scratch), source);
}

}  // namespace

std::string places_of(std::span<const watch::KeptAt> kept) {
  std::vector<std::string> places;
  for (const watch::KeptAt& one : kept) {
    if (one.folder.empty()) continue;
    // Both come from other processes.
    std::string place = without_control_characters(
        fmt::format("on {} in `{}`", one.machine.empty() ? "an unknown machine" : one.machine,
                    one.folder),
        " ");
    if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
  }
  if (places.empty()) return "The run left no recording.";
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), kMostPlaces); ++i) {
    const bool last = i > 0 && i + 1 == places.size();
    text += fmt::format("{}{}", i == 0 ? "" : (last ? ", and " : ", "), places[i]);
  }
  if (places.size() > kMostPlaces) {
    text += fmt::format(", and in {} more folders", places.size() - kMostPlaces);
  }
  return fmt::format("{} of this run {} {}.",
                     places.size() == 1 ? "The recording" : "The recordings",
                     places.size() == 1 ? "is" : "are", text);
}

Result<std::shared_ptr<Source>> open_kept(std::span<const watch::KeptAt> kept,
                                          const std::string& machine) {
  std::vector<fs::path> parts;
  bool hosts = false;
  for (const watch::KeptAt& one : kept) {
    const fs::path file = fs::path(one.folder) / (one.manager ? "world.mcap" : "run.mcap");
    const bool here = one.machine == machine && readable(file);
    // In real time the manager records nothing.
    if (!here && !one.manager) return fail(ErrorCode::kNotFound, "{}", places_of(kept));
    hosts = hosts || !one.manager;
    if (here) parts.push_back(file);
  }
  if (!hosts) return fail(ErrorCode::kNotFound, "{}", places_of(kept));
  fs::path place;
  const fs::path* const common = common_folder(kept, place);
  if (common == nullptr || kept.front().machine != machine) return merge(std::move(parts));
  // `rave info` and others find it there, too.
  if (const auto run = record::open_run(*common)) return open_recording(run->file);
  return merge(std::move(parts));
}

}  // namespace rave::gui_server
