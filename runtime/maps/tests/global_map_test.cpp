// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/global_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rave::maps {
namespace {

/// A tile of a map of 2 x 2 tiles; each cell has a value of its own that depends on `salt`.
MapTile filled_tile(std::uint32_t robot, Vec2 origin_W, std::uint32_t column, std::uint32_t row,
                    std::uint32_t salt) {
  MapTile tile{
      "r" + std::to_string(robot), robot, {0.1, origin_W, 128, 128}, column, row, 1, {}, {}};
  for (std::uint32_t i = 0; i < kTileCells * kTileCells; ++i) {
    const std::uint32_t value = (i * 7 + salt * 13) % 107;
    tile.cells.push_back(value > 100 ? kUnknown : static_cast<std::uint8_t>(value));
  }
  return tile;
}

double logit(double percent) {
  const double p = std::min(99.0, std::max(1.0, percent)) / 100;
  return std::log(p / (1 - p));
}

TEST(GlobalMap, IsTheCombinationOfTheLocalsCellByCell) {
  for (const double prior : {50.0, 30.0}) {
    GlobalMap map("global", prior);
    const MapTile a = filled_tile(0, {0, 0}, 1, 0, 1);
    // The same place in a map whose frame begins a tile farther left.
    const MapTile b = filled_tile(1, {-6.4, 0}, 1, 0, 2);
    const MapTile c = filled_tile(2, {6.4, 0}, 0, 0, 3);
    ASSERT_TRUE(map.add(a) && map.add(b) && map.add(c));
    const auto tiles = map.changed();
    ASSERT_EQ(tiles.size(), 2U) << "b lies beside the others";
    for (const MapTile& tile : tiles) {
      EXPECT_EQ(tile.source, "global");
      EXPECT_EQ(tile.robot, kNoRobot);
      EXPECT_DOUBLE_EQ(tile.frame.origin_W.x, -6.4);
      EXPECT_EQ(tile.frame.columns, 4 * kTileCells);
    }
    const MapTile& both = tiles[1];
    EXPECT_EQ(both.column, 2U);
    for (std::size_t i = 0; i < both.cells.size(); ++i) {
      const double l0 = std::log(prior / (100 - prior));
      double sum = l0;
      bool known = false;
      for (const MapTile* local : {&a, &c}) {
        if (local->cells[i] == kUnknown) continue;
        known = true;
        sum += logit(local->cells[i]) - l0;
      }
      if (!known) {
        EXPECT_EQ(both.cells[i], kUnknown);
      } else {
        EXPECT_NEAR(both.cells[i], 100 / (1 + std::exp(-sum)), 0.501);
      }
      EXPECT_EQ(both.cells[i], combined({a.cells[i], c.cells[i]}, prior));
    }
    EXPECT_EQ(tiles[0].cells[5], combined({b.cells[5]}, prior));
  }
}

TEST(GlobalMap, TheOrderOfRobotsDoesNotMatterAndTheNewestTileCounts) {
  MapTile a = filled_tile(0, {0, 0}, 0, 0, 1);
  const MapTile b = filled_tile(1, {0, 0}, 0, 0, 2);
  GlobalMap one;
  GlobalMap other;
  ASSERT_TRUE(one.add(a) && one.add(b));
  MapTile old = filled_tile(0, {0, 0}, 0, 0, 9);
  a.stamp = SimTime{1'000'000'000};
  ASSERT_TRUE(other.add(b) && other.add(a) && other.add(old));
  EXPECT_EQ(one.tiles().front().cells, other.tiles().front().cells);
  static_cast<void>(one.changed());
  EXPECT_TRUE(one.changed().empty());
  ASSERT_TRUE(one.add(b));
  EXPECT_TRUE(one.changed().empty()) << "the same again is no change";
}

TEST(GlobalMap, RefusesMapsThatDoNotFit) {
  GlobalMap map;
  ASSERT_TRUE(map.add(filled_tile(0, {0, 0}, 0, 0, 1)));
  MapTile coarse = filled_tile(1, {0, 0}, 0, 0, 1);
  coarse.frame.resolution_m = 0.2;
  const Status refused = map.add(coarse);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("cells of 0.2 m and others have cells of 0.1 m"),
            std::string::npos);
  const Status off = map.add(filled_tile(1, {0.03, 0}, 0, 0, 1));
  ASSERT_FALSE(off);
  EXPECT_NE(off.error().message.find("not in line"), std::string::npos);
  MapTile small = filled_tile(1, {0, 0}, 0, 0, 1);
  small.cells.resize(10);
  EXPECT_FALSE(map.add(small));
}

}  // namespace
}  // namespace rave::maps
