// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::replay {

/// Which robots of a record to play, and in what.
struct PlayArguments {
  std::filesystem::path record;
  std::vector<std::string> robots;  ///< Names in the record; empty: all.
  std::vector<std::string> anew;    ///< Virtual sensors that sense the new world instead.
  std::optional<std::filesystem::path> world;  ///< None: that of the record.
  std::optional<std::string> program;          ///< Driver name; none: no robot has a program.
  double start_s = 0;                          ///< Of the record; becomes run time 0.
  /// Where the files will be written. The paths in them are relative to it, so that it can be moved
  /// together with the recording. Empty: the paths are absolute.
  std::filesystem::path folder{};
};

/// The files of a scenario in which robots of a record are recorded real robots.
struct PlayedScenario {
  struct File {
    std::filesystem::path path;  ///< Relative to the scenario's folder.
    std::string text;
  };
  std::string name;
  std::vector<File> files;         ///< `scenario.yaml`, `world.yaml`, `robots/NAME.yaml`.
  std::vector<std::string> notes;  ///< What of a robot could not be taken over.
};

/// Makes the scenario: each sensor is played by a `playback_...` driver, each actuator takes
/// commands and ignores them. Errors: no record of RAVE, robots or sensors that are not in it.
[[nodiscard]] Result<PlayedScenario> played_scenario(const PlayArguments& arguments,
                                                     plugin::Catalogue& catalogue);

/// Writes the files below `folder`, which is created. Errors: kIo; kInvalidArgument if there is a
/// scenario already.
[[nodiscard]] Status write_played(const PlayedScenario& played,
                                  const std::filesystem::path& folder);

}  // namespace rave::replay
