// SPDX-License-Identifier: Apache-2.0
#include "played_files.hpp"

#include <map>

#include "rave/base/file.hpp"
#include "rave/base/named_path.hpp"
#include "rave/recording/provenance.hpp"

namespace rave::runtime {
namespace {

namespace fs = std::filesystem;

/// Where a file was when the run read it, and where it is now.
using Places = std::map<std::string, std::string>;

void replace(const std::string& robot_file, const Places& places, codec::RawNode& params) {
  if (!params.is_mapping()) return;
  for (std::size_t i = 0; i < params.size(); ++i) {
    const auto text = params.child(i).as_text();
    if (!text) continue;
    std::error_code error;
    const fs::path named =
        fs::absolute(named_path(fs::path(robot_file).parent_path(), *text), error);
    const auto place = places.find(named.lexically_normal().string());
    if (place == places.end()) continue;
    params.set(params.key(i), codec::RawNode::text(place->second));
  }
}

void replace(const std::string& robot_file, const Places& places, config::RobotFile& robot) {
  for (config::SensorFile& sensor : robot.sensors) {
    replace(robot_file, places, sensor.params);
    if (sensor.real) replace(robot_file, places, sensor.real->params);
  }
}

}  // namespace

Status put_played_files(const record::RunInfo& run, const fs::path& folder,
                        RecordedScenario& recorded) {
  // All of a folder or none: a log may be read with other files beside it.
  std::map<fs::path, fs::path> folders;
  for (const std::string& path : recorded.inside) {
    const auto now = sha256_of_file(path);
    if (now && *now == run.inputs.at(path)) continue;
    folders.try_emplace(fs::path(path).parent_path(), folder / std::to_string(folders.size()));
  }
  Places places;
  for (const std::string& path : recorded.inside) {
    const auto to = folders.find(fs::path(path).parent_path());
    if (to == folders.end()) continue;
    // Drivers may judge a file by the end of its name.
    const fs::path copy = to->second / fs::path(path).filename();
    RAVE_TRY(create_folder(to->second));
    RAVE_TRY(write_file_atomically(copy, *recorded.scenario.files.all().at(path)));
    places[path] = copy.string();
  }
  if (places.empty()) return {};
  for (config::RobotGroup& group : recorded.scenario.groups) {
    replace(group.file, places, group.robot);
    if (group.twin) replace(group.twin->file, places, group.twin->robot);
  }
  return {};
}

}  // namespace rave::runtime
