// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/maps/map_tile.hpp"

namespace rave::gui_server {

/// What the global map of the world file is called.
inline constexpr const char* kWorldMap = "world file";

/// The walls and landmarks of a world as a global map: what they cover is occupied, all else is
/// free. Virtual obstacles are left out. Cells are 0.05 m, or larger where that made more than 1024
/// along a side. `bodies_json`: as a Source gives it. Empty: nothing stands there.
[[nodiscard]] std::vector<maps::MapTile> world_map(const std::string& bodies_json);

}  // namespace rave::gui_server
