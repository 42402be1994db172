// SPDX-License-Identifier: Apache-2.0
// The one recording of a run, merged anew when its parts have changed.
#include <algorithm>

#include "rave/record/merge.hpp"

namespace rave::record {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord = "run.mcap";

/// The recordings of the processes of a run: the authority first, then hosts by name, each with its
/// starts in order.
std::vector<fs::path> parts_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> hosts;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "hosts", error)) {
    const fs::path record = entry.path() / kRecord;
    if (fs::is_regular_file(record, error)) hosts.push_back(record);
  }
  std::ranges::sort(hosts, {}, [](const fs::path& record) {
    std::string name = record.parent_path().filename().string();
    // By length first: host-10 comes after host-9.
    return std::pair(name.size(), name);
  });
  if (!hosts.empty() && fs::is_regular_file(folder / "world.mcap", error)) {
    hosts.insert(hosts.begin(), folder / "world.mcap");
  }
  return hosts;
}

/// Whether a recording was merged from exactly these files in their present state.
bool is_made_of(const fs::path& merged, const std::vector<fs::path>& parts) {
  const auto reader = McapReader::open(merged);
  if (!reader || !reader->whole()) return false;
  const auto files = merged_files(*reader);
  const bool same = std::ranges::all_of(parts, [&](const fs::path& part) {
    std::error_code error;
    const auto name = part.lexically_proximate(merged.parent_path()).generic_string();
    const auto known = files.find(name);
    // Sizes are enough to notice a part that has grown since, as in a run that was still in
    // progress.
    return known != files.end() && known->second == std::to_string(fs::file_size(part, error));
  });
  return same && files.size() == parts.size();
}

}  // namespace

Result<OpenedRun> open_run(const fs::path& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return OpenedRun{path, {}};
  OpenedRun run{path / kRecord, {}};
  const std::vector<fs::path> parts = parts_in(path);
  if (parts.empty()) return run;
  if (!is_made_of(run.file, parts)) RAVE_TRY(merge_records(parts, run.file));
  RAVE_TRY_ASSIGN(const auto reader, McapReader::open(run.file));
  run.notes = missing_parts(reader);
  return run;
}

}  // namespace rave::record
