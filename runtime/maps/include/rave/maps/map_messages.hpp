// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/topics.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::maps {

/// The bus message of a tile. It borrows the cells of `tile`, which must outlive it.
[[nodiscard]] bus::MapTile message_of(MapTile& tile);

/// The tile of a validated message.
[[nodiscard]] MapTile tile_of(const bus::MapTile& message);

}  // namespace rave::maps
