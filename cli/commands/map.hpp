// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave map-server`.
struct MapServerCommand {
  std::string run;  ///< Empty: the only one.
  BusOptions bus;
};

/// Combines the maps of the robots of a run until its end. Returns 0; 2 if there is no such run.
[[nodiscard]] Result<int> map_server(const MapServerCommand& options);

/// `rave map save`.
struct MapSaveCommand {
  std::string run;  ///< Empty: the only one.
  std::string map = "global";
  std::string file;  ///< Empty: the name of the map.
  BusOptions bus;
};

/// Writes a map of a run as files of ROS `map_server`. Returns 0; 2 if there is no such run or map.
[[nodiscard]] Result<int> map_save(const MapSaveCommand& options);

}  // namespace rave::cli
