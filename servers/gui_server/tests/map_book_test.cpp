// SPDX-License-Identifier: Apache-2.0
#include "run/map_book.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "page/map_stream.hpp"
#include "run/world_map.hpp"

namespace rave::gui_server {
namespace {

const std::string kRobots =
    R"([{"name":"a","sensors":[{"kind":"ranges"}]},{"name":"blind","sensors":[{"kind":"pose"}]},)"
    R"({"name":"c","sensors":[{"kind":"odometry"},{"kind":"ranges"}]}])";

maps::MapTile tile_of(std::uint32_t robot, std::int64_t stamp_ns, std::uint8_t value,
                      const std::string& source = "a") {
  return {source, robot, {0.1, {}, 2, 1}, 0, 0, 1, SimTime{stamp_ns}, {value, value}};
}

TEST(MapBook, NamesRobotsThatCanMakeAMapAndGlobalMaps) {
  MapBook book(kRobots, "[]");
  EXPECT_EQ(book.names(), (std::vector<MapName>{{0, "a"}, {2, "c"}}));
  const std::uint64_t before = book.names_revision();
  book.add(tile_of(maps::kNoRobot, 1, 5, "all"));
  EXPECT_EQ(book.names().back(), (MapName{maps::kNoRobot, "all"}));
  EXPECT_NE(book.names_revision(), before);
  // Of a robot that sees nothing, or is none.
  book.add(tile_of(1, 1, 5));
  book.add(tile_of(77, 1, 5));
  EXPECT_EQ(book.find({1, ""}), nullptr);
  EXPECT_EQ(book.find({77, ""}), nullptr);
}

TEST(MapBook, OfEachPlaceTheNewestTileCounts) {
  MapBook book(kRobots, "[]");
  EXPECT_EQ(book.find({0, ""}), nullptr);
  book.add(tile_of(0, 10, 50));
  book.add(tile_of(0, 5, 60));
  ASSERT_NE(book.find({0, ""}), nullptr);
  EXPECT_EQ(book.find({0, "whatever"})->tiles.at({0, 0}).cells.front(), 50);
  const std::uint64_t before = book.revision();
  book.add(tile_of(0, 20, 70));
  EXPECT_GT(book.revision(), before);
  EXPECT_EQ(book.find({0, ""})->tiles.at({0, 0}).cells.front(), 70);
  EXPECT_EQ(book.find({0, ""})->stamp.ns, 20);
  // A newer map with another frame takes the place of the whole.
  maps::MapTile other = tile_of(0, 30, 80);
  other.frame.origin_W.x = 3;
  other.frame.columns = 130;
  other.column = 2;
  book.add(other);
  EXPECT_EQ(book.find({0, ""})->tiles.size(), 1U);
  EXPECT_TRUE(book.find({0, ""})->tiles.contains({0, 2}));
}

TEST(MapBook, WhoMakesUpMapsGetsNoFurther) {
  MapBook book(kRobots, "[]");
  for (std::size_t i = 0; i < 2 * MapBook::kMostGlobals; ++i) {
    book.add(tile_of(maps::kNoRobot, 1, 5, "all " + std::to_string(i)));
  }
  EXPECT_EQ(book.names().size(), 2 + MapBook::kMostGlobals);
}

/// What a world map says of a place.
int cell_at(const std::vector<maps::MapTile>& tiles, double x_m, double y_m) {
  for (const maps::MapTile& tile : tiles) {
    const double cell_m = tile.frame.resolution_m;
    const double x =
        std::floor((x_m - tile.frame.origin_W.x) / cell_m) - tile.column * double{maps::kTileCells};
    const double y =
        std::floor((y_m - tile.frame.origin_W.y) / cell_m) - tile.row * double{maps::kTileCells};
    const std::uint32_t width = maps::MapFrame::side(tile.frame.columns, tile.column);
    const std::uint32_t height = maps::MapFrame::side(tile.frame.rows, tile.row);
    if (x < 0 || y < 0 || x >= width || y >= height) continue;
    return tile.cells.at(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
  }
  return -1;
}

TEST(WorldMap, HasWallsAndLandmarksButNoVirtualObstacles) {
  const auto tiles = world_map(
      R"([{"kind":"wall","pose":[2,0,0],"shapes":[{"polygon":[[0,-3],[0.01,-3],[0.01,3],[0,3]]}]},)"
      R"({"kind":"landmark","pose":[5,1,1.5707963],"shapes":[{"disc":[1,0,0.3]}]},)"
      R"({"kind":"virtual","pose":[4,-1,0],"shapes":[{"disc":[0,0,0.5]}]}])");
  ASSERT_FALSE(tiles.empty());
  EXPECT_EQ(tiles.front().source, kWorldMap);
  EXPECT_EQ(cell_at(tiles, 2.005, 2.5), 100) << "a wall that is thinner than a cell";
  EXPECT_EQ(cell_at(tiles, 2.2, 2.5), 0);
  EXPECT_EQ(cell_at(tiles, 5, 2.2), 100) << "a disc in the frame of its body";
  EXPECT_EQ(cell_at(tiles, 4, -1), 0) << "a virtual obstacle";
  EXPECT_EQ(cell_at(tiles, 40, 0), -1) << "outside";
  EXPECT_TRUE(world_map("[]").empty());
}

TEST(WorldMap, OfALargeWorldHasLargerCells) {
  const auto tiles = world_map(
      R"([{"kind":"wall","pose":[0,0,0],"shapes":[{"disc":[-500,0,1]},{"disc":[500,0,1]}]}])");
  ASSERT_FALSE(tiles.empty());
  EXPECT_LE(tiles.front().frame.columns, 1024U);
  EXPECT_EQ(cell_at(tiles, -500, 0), 100);
  EXPECT_EQ(cell_at(tiles, 0, 0), 0);
}

}  // namespace
}  // namespace rave::gui_server
