// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/map_messages.hpp"

#include "rave/bus/sequence.hpp"

namespace rave::maps {

static_assert(kTileCells == rave_wire_kTileCells && kUnknown == rave_wire_kCellUnknown &&
              kNoRobot == rave_wire_kNone);

bus::MapTile message_of(MapTile& tile) {
  bus::MapTile message{};
  bus::put_text(message.source, tile.source);
  message.column = tile.column;
  message.row = tile.row;
  message.robot = tile.robot;
  message.resolution_m = tile.frame.resolution_m;
  message.origin_x_m = tile.frame.origin_W.x;
  message.origin_y_m = tile.frame.origin_W.y;
  message.columns = tile.frame.columns;
  message.rows = tile.frame.rows;
  message.revision = tile.revision;
  message.stamp_ns = tile.stamp.ns;
  bus::borrow(message.cells, tile.cells);
  return message;
}

MapTile tile_of(const bus::MapTile& message) {
  MapTile tile;
  tile.source = message.source;
  tile.robot = message.robot;
  tile.frame = {message.resolution_m,
                {message.origin_x_m, message.origin_y_m},
                message.columns,
                message.rows};
  tile.column = message.column;
  tile.row = message.row;
  tile.revision = message.revision;
  tile.stamp = SimTime{message.stamp_ns};
  const auto cells = bus::elements(message.cells);
  tile.cells.assign(cells.begin(), cells.end());
  return tile;
}

}  // namespace rave::maps
