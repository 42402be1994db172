// SPDX-License-Identifier: Apache-2.0
#include "rave/results/map_result.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rave::runtime {
namespace {

/// A world with a disc of 1 m at (1.6, 1.6), and a tile of 3.2 m from the origin in which all cells
/// have one value.
MapAccuracy judged(std::uint8_t cell) {
  sim::EngineSpec spec;
  spec.robots.resize(1);
  spec.robots[0].name = "r";
  world::Obstacle obstacle;
  obstacle.body.shapes.push_back(*world::make_disc({0, 0}, 1, 0, 1));
  obstacle.X_WB = {1.6, 1.6, 0};
  spec.world.obstacles.push_back(obstacle);
  RunFacts facts;
  facts.maps.push_back({0, 0.05, {0, 0}, 64, 64, 0, 0, 1, {}});
  facts.maps.front().cells.assign(64 * 64, cell);
  const auto results = map_results(spec, facts);
  EXPECT_TRUE(results && results->global);
  EXPECT_EQ(results->locals.size(), 1U);
  return results && results->global ? *results->global : MapAccuracy{};
}

constexpr double kDisc = 3.14159 / (3.2 * 3.2);  // Its share of the tile.

TEST(MapResult, FreeCellsInsideAnObstacleAreWrong) {
  const MapAccuracy map = judged(3);
  EXPECT_EQ(map.free, 64U * 64U);
  EXPECT_NEAR(static_cast<double>(map.free_right) / (64 * 64), 1 - kDisc, 0.01);
  EXPECT_NEAR(map.known_m2, 3.2 * 3.2, 1e-9);
}

TEST(MapResult, OccupiedCellsFarFromObstaclesAreWrong) {
  const MapAccuracy map = judged(97);
  EXPECT_EQ(map.occupied, 64U * 64U);
  EXPECT_NEAR(static_cast<double>(map.occupied_right) / (64 * 64), 1.1 * 1.1 * kDisc, 0.01);
  EXPECT_GT(map.wall_error_m, 0.1);
}

TEST(MapResult, TheRestIsUndecidedOrUnknown) {
  EXPECT_EQ(judged(50).undecided, 64U * 64U);
  EXPECT_EQ(judged(maps::kUnknown).unknown, 64U * 64U);
  EXPECT_EQ(judged(maps::kUnknown).known_m2, 0);
}

TEST(MapResult, WithoutMapsThereIsNone) { EXPECT_FALSE(map_results({}, {})); }

}  // namespace
}  // namespace rave::runtime
