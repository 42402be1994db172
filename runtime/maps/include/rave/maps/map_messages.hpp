// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/topics.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::maps {

/// The message of a tile. It shows the cells of `tile`, which has to live as long as it is used.
[[nodiscard]] bus::MapTile message_of(MapTile& tile);

/// The tile of a message that was validated.
[[nodiscard]] MapTile tile_of(const bus::MapTile& message);

}  // namespace rave::maps
