// SPDX-License-Identifier: Apache-2.0
// From a scenario with its files to one complete description. Whatever reads an expanded scenario
// needs no other file except components of the page and what drivers play.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "expansion_checks.hpp"
#include "rave/base/named_path.hpp"
#include "rave/base/names.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/config/gui_of_scenario.hpp"
#include "rave/config/map_image.hpp"
#include "scenario_fields.hpp"
#include "start_poses.hpp"

namespace rave::config {
namespace {

namespace fs = std::filesystem;

class Expansion {
 public:
  Expansion(ScenarioFile scenario, const fs::path& path, InputFiles files = {})
      : folder_(path.parent_path()) {
    expanded_.scenario = std::move(scenario);
    expanded_.files = std::move(files);
  }

  // All files are read before anything is refused, so that a user sees all errors at once. What
  // depends on all of them is checked only if each is right by itself.
  Result<ExpandedScenario> run() && {
    expand_world();
    expand_gui();
    const fs::path folder = absolute(folder_);
    for (CompanionFile& companion : expanded_.scenario.companions) {
      expand_companion(companion, folder);
    }
    expand_script();
    expand_robots();
    if (diagnostics_.ok()) check_expansion(expanded_, diagnostics_);
    if (diagnostics_.ok()) return std::move(expanded_);
    return tl::unexpected<Error>(diagnostics_.joined());
  }

  Result<GuiOfScenario> run_gui(const fs::path& path) && {
    GuiOfScenario read;
    read.files.push_back(path);
    if (const auto& file = expanded_.scenario.gui.file) {
      read.files.push_back(beside(folder_, **file));
    }
    expand_gui();
    if (!diagnostics_.ok()) return tl::unexpected<Error>(diagnostics_.joined());
    read.gui = std::move(expanded_.scenario.gui);
    return read;
  }

 private:
  void report(const SourceLocation& where, std::string message,
              ErrorCode code = ErrorCode::kParse) {
    diagnostics_.add(Error{code, std::move(message), where});
  }

  /// Reads the file that a line names; errors are reported at that line.
  std::optional<std::string> read(const fs::path& path, const SourceLocation& where) {
    auto text = rave::read_file(path, kMaxFileBytes);
    if (text) return *std::move(text);
    report(where, text.error().message, text.error().code);
    return std::nullopt;
  }

  /// Reads the file that `where` names into `target`, which stays as it is after an error.
  template <class T, class ReadText>
  void read_into(T& target, const fs::path& path, const SourceLocation& where, ReadText read_text) {
    const auto text = read(path, where);
    if (!text) return;
    Result<T> content = read_text(*text, path.string());
    if (content) {
      target = *std::move(content);
    } else {
      diagnostics_.add(std::move(content).error());
    }
  }
  static fs::path beside(const fs::path& folder, const std::string& name) {
    return named_path(folder, name).lexically_normal();
  }

  /// Resolves against the current folder, which may not exist any more; no other access to the
  /// disk.
  static std::string absolute(const fs::path& path) {
    std::error_code error;
    const fs::path whole = fs::absolute(path, error);
    return (error ? path : whole).lexically_normal().string();
  }

  void expand_world() {
    WorldFile& world = expanded_.world;
    ScenarioFile& scenario = expanded_.scenario;
    if (scenario.world) {
      const fs::path path = beside(folder_, **scenario.world);
      read_into(world, path, scenario.world->where, read_world_text);
      resolve_maps(world.maps, path.parent_path());
    }
    resolve_maps(scenario.maps, folder_);
    // Obstacles and maps of the scenario come after those of the world, so their numbers do not
    // change when a scenario adds some.
    std::move(scenario.obstacles.begin(), scenario.obstacles.end(),
              std::back_inserter(world.obstacles));
    std::move(scenario.maps.begin(), scenario.maps.end(), std::back_inserter(world.maps));
    scenario.obstacles.clear();
    scenario.maps.clear();
    // The expanded scenario is complete by itself: names of files that were read are gone.
    scenario.world.reset();
    world.description.clear();
  }

  void expand_gui() {
    GuiFile& gui = expanded_.scenario.gui;
    fs::path folder = folder_;
    if (const auto file = std::exchange(gui.file, std::nullopt)) {
      const fs::path path = beside(folder_, **file);
      folder = path.parent_path();
      read_into(gui, path, file->where, read_gui_text);
    }
    for (GuiComponentFile& component : gui.components) {
      component.module.value = absolute(beside(folder, *component.module));
    }
  }

  void expand_script() {
    const auto& script = expanded_.scenario.script;
    auto& source = expanded_.scenario.script_source;
    if (script && !source) source = read(beside(folder_, **script), script->where);
  }

  void resolve_maps(std::vector<MapFile>& maps, const fs::path& folder) {
    for (MapFile& map : maps) {
      const fs::path path = beside(folder, *map.file);
      if (auto yaml = expanded_.files.read(path, kMaxFileBytes)) {
        expanded_.files.add(path, *std::move(yaml));
      } else {
        report(map.file.where, yaml.error().message, yaml.error().code);
      }
      // What is wrong in it is reported when the world is made.
      if (auto all = read_map_files(path, expanded_.files)) {
        expanded_.files.add(all->image_path, std::move(all->image));
      }
      map.file.value = absolute(path);
    }
  }

  void expand_robots() {
    std::vector<RobotEntry> entries = std::move(expanded_.scenario.robots);
    expanded_.scenario.robots.clear();
    for (RobotEntry& entry : entries) expand_entry(entry);
  }

  void expand_entry(RobotEntry& entry) {
    const std::size_t group = expanded_.groups.size();
    RobotGroup& common = expanded_.groups.emplace_back();
    common.name = entry.name;
    common.part_of = std::move(entry.part_of);
    common.team = std::move(entry.team);
    common.kind = std::move(entry.kind);
    common.scatter = entry.scatter;
    if (entry.file) common.file = absolute(beside(folder_, **entry.file));
    if (entry.robot) {
      common.robot = *std::move(entry.robot);
    } else {
      read_robot(*entry.file, entry.variables, common.robot);
    }
    expand_twin(entry, common);
    add_robots(entry, group);
  }

  void expand_twin(RobotEntry& entry, RobotGroup& common) {
    common.hand_over = entry.hand_over;
    common.shadow = entry.shadow;
    if (!entry.twin && !entry.twin_robot) return;
    TwinGroup& twin = common.twin.emplace();
    if (entry.twin) twin.file = absolute(beside(folder_, **entry.twin));
    if (entry.twin_robot) {
      twin.robot = *std::move(entry.twin_robot);
    } else {
      read_robot(*entry.twin, entry.variables, twin.robot);
    }
  }

  void read_robot(const Located<std::string>& file, const Variables& variables, RobotFile& robot) {
    const fs::path path = beside(folder_, *file);
    read_into(robot, path, file.where, [&variables](std::string_view text, std::string_view name) {
      return read_robot_text(text, name, variables);
    });
  }

  void add_robots(const RobotEntry& entry, std::size_t group) {
    const std::size_t count = robots_of(entry);
    if (expanded_.robots.size() + count > static_cast<std::size_t>(kMaxRobots)) {
      return report(entry.name.where, fmt::format("more than {} robots", kMaxRobots));
    }
    for (std::size_t i = 0; i < count; ++i) {
      ExpandedRobot robot;
      robot.group = group;
      // One robot has the name of its entry; of several each has a number, from 1.
      robot.name = count == 1 ? *entry.name : fmt::format("{}-{}", *entry.name, i + 1);
      robot.pose = pose_of(entry, i);
      if (robot.pose &&
          std::max(std::abs(robot.pose->x_m), std::abs(robot.pose->y_m)) > kFarthest_m) {
        return report(entry.name.where,
                      fmt::format("robot `{}` is farther than {} m from the origin", robot.name,
                                  kFarthest_m));
      }
      expanded_.robots.push_back(std::move(robot));
    }
  }

  fs::path folder_;
  ExpandedScenario expanded_;
  Diagnostics diagnostics_;
};

}  // namespace

std::vector<std::size_t> robots_named(const ExpandedScenario& scenario, std::string_view name) {
  std::vector<std::size_t> found;
  for (std::size_t r = 0; r < scenario.robots.size(); ++r) {
    if (scenario.robots[r].name == name) return {r};
    const RobotGroup& group = scenario.group_of(scenario.robots[r]);
    if (group.name.value == name || group.part_of == name) found.push_back(r);
  }
  return found;
}

std::string robot_suggestion(const ExpandedScenario& scenario, std::string_view name) {
  std::set<std::string_view> names;
  for (const RobotGroup& group : scenario.groups) {
    names.insert(*group.name);
    if (!group.part_of.empty()) names.insert(group.part_of);
  }
  for (const ExpandedRobot& robot : scenario.robots) names.insert(robot.name);
  return suggestion(name, std::vector(names.begin(), names.end()));
}

Result<ExpandedScenario> expand_scenario_file(ScenarioFile scenario,
                                              const std::filesystem::path& path) {
  return Expansion(std::move(scenario), path).run();
}

Result<ExpandedScenario> expand_scenario_text(std::string_view text,
                                              const std::filesystem::path& path, InputFiles files) {
  RAVE_TRY_ASSIGN(ScenarioFile scenario, read_scenario_text(text, path.string()));
  return Expansion(std::move(scenario), path, std::move(files)).run();
}

Result<GuiOfScenario> read_gui_of(const std::filesystem::path& scenario) {
  RAVE_TRY_ASSIGN(const std::string text, rave::read_file(scenario, kMaxFileBytes));
  RAVE_TRY_ASSIGN(ScenarioFile file, read_scenario_text(text, scenario.string()));
  return Expansion(std::move(file), scenario).run_gui(scenario);
}

Result<ExpandedScenario> expand_scenario(const std::filesystem::path& path, Settings settings) {
  RAVE_TRY_ASSIGN(const std::string text, rave::read_file(path, kMaxFileBytes));
  const auto prepare = [&](RawNode& tree, Diagnostics& diagnostics) {
    apply_settings(tree, settings, path.parent_path(), diagnostics);
    if (diagnostics.ok()) prepare_robots(tree, diagnostics);
  };
  RAVE_TRY_ASSIGN(ScenarioFile scenario, read_text<ScenarioFile>(text, path.string(), prepare));
  return Expansion(std::move(scenario), path).run();
}

}  // namespace rave::config
