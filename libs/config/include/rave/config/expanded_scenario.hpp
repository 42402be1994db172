// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/scenario_file.hpp"

namespace rave::config {

/// The other drivers of a robot: a robot file of the same robot.
struct TwinGroup {
  std::string file;  ///< As RobotGroup::file.
  RobotFile robot;
  bool operator==(const TwinGroup&) const = default;
};

/// What the robots of one entry of the scenario have in common.
struct RobotGroup {
  Located<std::string> name;  ///< As written; the place is the entry's, for later errors.
  std::string team;
  std::optional<std::string> kind;
  /// Absolute path of the robot file, which relative paths among its parameters start from; empty
  /// if the robot was written out in the scenario alone.
  std::string file;
  RobotFile robot;
  std::optional<ScatterFile> scatter;  ///< Set: the robots have no poses yet.
  std::optional<TwinGroup> twin;       ///< Set: it is one robot.
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

/// A scenario with all that it refers to. A value.
struct ExpandedScenario {
  /// Settings, checks and picture. Its world, obstacles, maps and robots were moved to the members
  /// below and are empty here.
  ScenarioFile scenario;
  std::vector<RobotGroup> groups;     ///< In the order of the file.
  std::vector<ExpandedRobot> robots;  ///< By group; names are unique.
  /// World and scenario together; names are unique, map files absolute and present.
  WorldFile world;

  [[nodiscard]] const RobotGroup& group_of(const ExpandedRobot& robot) const {
    return groups[robot.group];
  }
  bool operator==(const ExpandedScenario&) const = default;
};

/// The indices of the robots that a name stands for: one robot, or all of an entry. Empty: none.
[[nodiscard]] std::vector<std::size_t> robots_named(const ExpandedScenario& scenario,
                                                    std::string_view name);

/// One host of a scenario that is shared among several.
struct PlannedHost {
  std::string name;
  std::vector<std::size_t> robots;  ///< Indices, ascending; at least one.
  bool elsewhere = false;           ///< Started by hand, not by `rave run`.
  bool operator==(const PlannedHost&) const = default;
};

/// Who runs which robot: by `hosts`, or `processes` equal parts in the order of the robots. Empty:
/// one process runs them all. Errors: kParse (no such robot, a robot of two hosts or of none, a
/// host without robots, more processes than robots).
[[nodiscard]] Result<std::vector<PlannedHost>> plan_hosts(const ExpandedScenario& scenario);

/// After how many steps the host of a robot says again where it is; at least 1.
[[nodiscard]] std::uint32_t report_period_steps(const ExpandedScenario& scenario,
                                                const ExpandedRobot& robot);

/// Reads a scenario and the files it names (a robot file once per entry) and checks them together:
/// names, periods that are multiples of the step, sensors that checks and picture name, files that
/// do not exist (error at the line that names them). Errors: kNotFound, kIo, kParse.
[[nodiscard]] Result<ExpandedScenario> expand_scenario(const std::filesystem::path& path);
/// The same for a text that stands in for the file `path`.
[[nodiscard]] Result<ExpandedScenario> expand_scenario_text(std::string_view text,
                                                            const std::filesystem::path& path);

/// The same for a scenario that was made by code; `path` is where it would stand.
[[nodiscard]] Result<ExpandedScenario> expand_scenario_file(ScenarioFile scenario,
                                                            const std::filesystem::path& path);

/// One scenario file that says everything, all defaults included; expanding it anywhere gives an
/// equal value as long as the maps exist.
[[nodiscard]] std::string write_expanded(const ExpandedScenario& expanded);

}  // namespace rave::config
