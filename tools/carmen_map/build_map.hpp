// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "carmen/log.hpp"
#include "rave/base/result.hpp"
#include "rave/estimate/map_files.hpp"

namespace rave::tools {

struct MapOptions {
  std::filesystem::path log;
  double fov_deg = 0;  ///< From the first beam to the last; 0: as the rows of the log say.
  double yaw_deg = 0;  ///< Of the middle of the field, from the x axis of the logged pose.
  double resolution_m = 0.05;
  carmen::LaserSide side = carmen::LaserSide::kFront;
  double no_return_m = -1;  ///< As of carmen::LoadOptions.
  estimate::BeamModel beams;
  estimate::MapThresholds thresholds;
};

/// The two files of a map.
struct MapFiles {
  std::string image;
  std::string yaml;
  std::string summary;             ///< One line for the terminal.
  std::vector<std::string> notes;  ///< What the user may not expect, a sentence each.
  /// Why it is a map of nearly nothing: fewer than ten scans, or less than half of those of the
  /// log. Empty: it is not.
  std::string poor;
};

/// Takes every scan of the window of a log into a grid that holds all of them.
/// Times do not matter for it, only the order of the scans.
/// Errors: scans without poses; those of carmen::load() and OccupancyGrid::create().
[[nodiscard]] Result<MapFiles> build_map(const MapOptions& options, const std::string& image_name);

}  // namespace rave::tools
