// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/map_messages.hpp"

#include <gtest/gtest.h>

#include "rave/bus/validate.hpp"

namespace rave::maps {
namespace {

TEST(MapMessages, ATileComesBackAsItWas) {
  MapTile tile{"walker-1", 3, {0.05, {-1.5, 2.25}, 70, 66}, 1, 1, 7, SimTime{125}, {}};
  tile.cells = {0, 50, 100, kUnknown, 1, 2, 3, 4, 5, 6, 7, 8};
  bus::MapTile message = message_of(tile);
  message.writer = 1;
  ASSERT_TRUE(bus::validate(message)) << bus::validate(message).error().message;
  const MapTile back = tile_of(message);
  EXPECT_EQ(back.source, "walker-1");
  EXPECT_EQ(back.robot, 3U);
  EXPECT_TRUE(back.frame == tile.frame);
  EXPECT_EQ(back.column, 1U);
  EXPECT_EQ(back.row, 1U);
  EXPECT_EQ(back.revision, 7U);
  EXPECT_EQ(back.stamp.ns, 125);
  EXPECT_EQ(back.cells, tile.cells);
}

TEST(MapMessages, TheLargestTileFitsAMessage) {
  MapTile tile{std::string(64, 'n'), kNoRobot, {0.1, {}, 64, 64}, 0, 0, 1, {}, {}};
  tile.cells.assign(std::size_t{kTileCells} * kTileCells, kUnknown);
  const bus::MapTile message = message_of(tile);
  EXPECT_EQ(message.cells._length, std::uint32_t{rave_wire_kMaxTileCells});
  EXPECT_EQ(std::string(message.source), tile.source);
  EXPECT_EQ(message.robot, std::uint32_t{rave_wire_kNone});
}

}  // namespace
}  // namespace rave::maps
