// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/input_files.hpp"
#include "rave/config/scenario_file.hpp"
#include "rave/config/settings.hpp"

namespace rave::config {

/// The second set of drivers of a robot: another robot file for the same robot.
struct TwinGroup {
  std::string file;  ///< As RobotGroup::file.
  RobotFile robot;
  bool operator==(const TwinGroup&) const = default;
};

/// Properties shared by all robots of one entry of the scenario.
struct RobotGroup {
  Located<std::string> name;  ///< As written, with the place of the entry for later errors.
  std::string part_of;        ///< As RobotEntry::part_of.
  std::string team;
  std::optional<std::string> kind;
  /// Absolute path of the robot file, the base of relative paths among its parameters; empty if the
  /// robot is defined in the scenario itself.
  std::string file;
  RobotFile robot;
  std::optional<ScatterFile> scatter;  ///< If set, poses are still to be drawn.
  std::optional<TwinGroup> twin;       ///< If set, the entry is one robot.
  HandOverFile hand_over;
  bool shadow = false;  ///< With `twin` only.
  bool operator==(const RobotGroup&) const = default;
};

/// One robot. Its id is its index in ExpandedScenario::robots.
struct ExpandedRobot {
  std::string name;
  std::size_t group = 0;
  /// Unset: it is scattered, or the scenario gives no pose.
  std::optional<PoseFile> pose;
  bool operator==(const ExpandedRobot&) const = default;
};

/// A scenario and all files that it refers to. A value.
struct ExpandedScenario {
  /// Settings, checks and picture. Its world, obstacles, maps and robots are moved to the members
  /// below and are empty here.
  ScenarioFile scenario;
  std::vector<RobotGroup> groups;     ///< In the order of the file.
  std::vector<ExpandedRobot> robots;  ///< By group; names are unique.
  /// Obstacles of the world file and the scenario; names are unique, map files exist and have
  /// absolute paths.
  WorldFile world;
  /// The maps of the world and their images, read once. Not in write_expanded().
  InputFiles files;

  [[nodiscard]] const RobotGroup& group_of(const ExpandedRobot& robot) const {
    return groups[robot.group];
  }
  bool operator==(const ExpandedScenario&) const = default;
};

/// The indices of the robots with this name: one robot, or all robots of an entry or of the entries
/// that are part of it. Empty: none.
[[nodiscard]] std::vector<std::size_t> robots_named(const ExpandedScenario& scenario,
                                                    std::string_view name);

/// The end of a message about a name that robots_named() does not find; see suggestion().
[[nodiscard]] std::string robot_suggestion(const ExpandedScenario& scenario, std::string_view name);

/// One host of a scenario with several hosts.
struct PlannedHost {
  std::string name;
  std::vector<std::size_t> robots;  ///< Indices, ascending; at least one.
  bool elsewhere = false;           ///< Started by hand, not by `rave run`.
  bool operator==(const PlannedHost&) const = default;
};

/// Assigns robots to hosts: by `hosts`, or `processes` equal parts in the order of the robots.
/// Empty: one process runs them all. Errors: kParse (unknown robot, a robot of two hosts or of
/// none, a host without robots, more processes than robots).
[[nodiscard]] Result<std::vector<PlannedHost>> plan_hosts(const ExpandedScenario& scenario);

/// The period at which the host of a robot publishes its state, in steps, rounded up; at least 1.
[[nodiscard]] std::uint32_t report_period_steps(const ExpandedScenario& scenario,
                                                const ExpandedRobot& robot);

/// Reads a scenario and the files it names (a robot file once per entry) and checks them together:
/// names, periods that must be multiples of the step, sensors that checks and picture name, missing
/// files (error at the line that names them). Errors: kNotFound, kIo, kParse.
/// `settings` take the place of what the file says; see apply_settings().
[[nodiscard]] Result<ExpandedScenario> expand_scenario(const std::filesystem::path& path,
                                                       Settings settings = {});
/// Like expand_scenario(), for a text instead of the content of file `path`. Maps that `files` has
/// are not looked for on the disk.
[[nodiscard]] Result<ExpandedScenario> expand_scenario_text(std::string_view text,
                                                            const std::filesystem::path& path,
                                                            InputFiles files = {});

/// Like expand_scenario(), for a scenario made by code; `path` is the base of relative paths.
[[nodiscard]] Result<ExpandedScenario> expand_scenario_file(ScenarioFile scenario,
                                                            const std::filesystem::path& path);

/// The scenario as one self-contained file with all defaults; of obstacles and changes only what is
/// set, without comments. Expanding it in any folder gives an equal value as long as the map files
/// exist and did not change.
[[nodiscard]] std::string write_expanded(const ExpandedScenario& expanded);

}  // namespace rave::config
