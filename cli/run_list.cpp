// SPDX-License-Identifier: Apache-2.0
#include "run_list.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "places.hpp"
#include "rave/base/file.hpp"
#include "rave/base/json_text.hpp"
#include "rave/config/scenario_file.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;
using ListJson = nlohmann::ordered_json;

constexpr std::size_t kMostListedBytes = std::size_t{4} << 20U;
constexpr std::size_t kMostRecordings = 50;
const char* const kRunsFolder = "runs";

std::string scenarios_json() {
  ListJson list = ListJson::array();
  for (const std::string& name : known_scenarios()) {
    ListJson entry = {{"name", name}, {"text", ""}};
    const auto file = find_scenario(name);
    const auto text =
        file ? read_file(*file, kMostListedBytes) : Result<std::string>(std::string());
    // A file with errors is in the list as well: starting it says what is wrong.
    const auto scenario =
        config::read_scenario_text(text.value_or(""), file ? file->string() : name);
    if (scenario) {
      entry["text"] = scenario->description;
      const bool open = scenario->duration_s.is_open();
      entry["duration_s"] = open ? ListJson() : ListJson(scenario->duration_s.seconds);
      entry["seed"] = scenario->seed;
      entry["people"] = scenario->users.size();
    }
    list.push_back(std::move(entry));
  }
  return json_text(list);
}

/// What people look for in a list: the whole is in the result.
ListJson recording_json(const fs::path& folder) {
  ListJson entry = {{"name", folder.filename().string()}, {"scenario", ""}, {"verdict", "none"}};
  const auto text = read_file(folder / "result.json", kMostListedBytes);
  const ListJson result = ListJson::parse(text.value_or(""), nullptr, false);
  if (!result.is_object()) return entry;
  entry["scenario"] = result.value("scenario", "");
  entry["seed"] = result.value("seed", std::uint64_t{0});
  entry["lasted_s"] = result.value("simulated_s", 0.0);
  if (const auto hash = result.find("hash"); hash != result.end() && hash->is_string()) {
    entry["hash"] = *hash;
  }
  const bool whole = result.value("whole", false);
  const bool holds = result.value("checks_hold", false);
  entry["verdict"] = !whole ? "broke_off" : holds ? "passed" : "failed";
  return entry;
}

std::string recordings_json() {
  std::vector<std::pair<fs::file_time_type, fs::path>> folders;
  std::error_code error;
  for (fs::directory_iterator entry(kRunsFolder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const fs::path& folder = entry->path();
    const bool recorded =
        fs::exists(folder / "run.mcap", ignored) || fs::is_directory(folder / "hosts", ignored);
    if (recorded) folders.emplace_back(fs::last_write_time(folder, ignored), folder);
  }
  std::sort(folders.rbegin(), folders.rend());
  if (folders.size() > kMostRecordings) folders.resize(kMostRecordings);
  ListJson list = ListJson::array();
  for (const auto& [time, folder] : folders) list.push_back(recording_json(folder));
  return json_text(list);
}

}  // namespace

RunList RunList::read() { return {scenarios_json(), recordings_json()}; }

Result<fs::path> folder_of_recording(const std::string& name) {
  std::error_code error;
  const fs::path folder = fs::path(kRunsFolder) / name;
  // A page names a folder of the list, and nothing beside it.
  const bool plain = fs::path(name).filename() == name && name != "." && name != "..";
  if (plain && !name.empty() && fs::is_directory(folder, error)) return folder;
  return fail(ErrorCode::kNotFound, "There is no recording `{}`.", name);
}

}  // namespace rave::cli
