// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::maps {

/// Writes a map as `base`.pgm and `base`.yaml for `map_server` of ROS, with the thresholds that
/// `map_saver` writes: more than 65 % occupied, less than 19.6 % free, between them unknown. Of
/// tiles of one place the last counts. Errors: kInvalidArgument (no tiles), kIo.
[[nodiscard]] Status save(const std::vector<MapTile>& tiles, const std::filesystem::path& base);

}  // namespace rave::maps
