// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/explorer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

/// A map of 6 m by 6 m around the origin. A laser in the middle of the left of two rooms sees that
/// room; a wall with a door at y = 0 is at x = 1.
OccupancyGrid two_rooms(double door_m) {
  auto grid = OccupancyGrid::create({0.05, {-3, -3}, 120, 120}, {});
  EXPECT_TRUE(grid);
  std::vector<double> bearings_rad;
  std::vector<float> ranges_m;
  for (int k = 0; k < 720; ++k) {
    const double bearing_rad = (k + 0.5) * kPi / 360 - kPi;
    const SinCos u = sincos(bearing_rad);
    double range_m = 1e9;
    if (u.cos > 0 && std::abs(u.sin / u.cos) > 0.5 * door_m) range_m = 1 / u.cos;
    if (u.cos < 0) range_m = std::min(range_m, -2 / u.cos);
    if (u.sin != 0) range_m = std::min(range_m, 2 / std::abs(u.sin));
    bearings_rad.push_back(bearing_rad);
    ranges_m.push_back(static_cast<float>(range_m));
  }
  for (int k = 0; k < 3; ++k) grid->add({{0, 0, 0}, bearings_rad, ranges_m});
  return *std::move(grid);
}

TEST(Explorer, TheFrontierIsBehindTheDoor) {
  const OccupancyGrid grid = two_rooms(1.0);
  Explorer explorer;
  std::vector<Vec2> way_W;
  ASSERT_TRUE(explorer.to_frontier(grid, {-0.5, 0.5}, std::nullopt, way_W));
  ASSERT_GE(way_W.size(), 3U);
  EXPECT_NEAR(way_W.front().x, -0.5, 0.21);
  EXPECT_GT(way_W.back().x, 0.9);
  EXPECT_LT(std::abs(way_W.back().y), 0.9);
  for (std::size_t i = 1; i < way_W.size(); ++i) {
    EXPECT_LT(squared_norm(way_W[i] - way_W[i - 1]), 0.3 * 0.3);
  }
}

TEST(Explorer, AFrontierIsKeptAndGivenUp) {
  const OccupancyGrid grid = two_rooms(1.0);
  Explorer explorer;
  std::vector<Vec2> way_W;
  ASSERT_TRUE(explorer.to_frontier(grid, {0, 0.3}, std::nullopt, way_W));
  const Vec2 first = way_W.back();
  ASSERT_TRUE(explorer.to_frontier(grid, {0, -0.4}, first, way_W));
  EXPECT_EQ(way_W.back().y, first.y) << "though another one may be nearer now";
  explorer.give_up(grid, first, 0.1);
  if (explorer.to_frontier(grid, {0, 0.3}, first, way_W)) {
    EXPECT_GT(squared_norm(way_W.back() - first), 0.01);
  }
  explorer.give_up(grid, {0, 0}, 10);
  EXPECT_FALSE(explorer.to_frontier(grid, {0, 0}, std::nullopt, way_W));
  EXPECT_TRUE(way_W.empty());
}

TEST(Explorer, ThroughADoorThatIsTooNarrowThereIsNoWay) {
  const OccupancyGrid grid = two_rooms(0.2);
  Explorer explorer;
  std::vector<Vec2> way_W;
  EXPECT_FALSE(explorer.to_goal(grid, {0, 0}, {2, 0}, way_W));
  EXPECT_FALSE(explorer.to_goal(grid, {0, 0}, {50, 0}, way_W)) << "outside of the map";
  EXPECT_FALSE(explorer.to_frontier(grid, {50, 0}, std::nullopt, way_W));
  ASSERT_TRUE(explorer.to_goal(grid, {0, 0}, {-1.5, 1.5}, way_W));
  EXPECT_EQ(way_W.back().x, -1.5);
}

TEST(Explorer, AGoalInUnknownSpaceIsDrivenTo) {
  const OccupancyGrid grid = two_rooms(1.0);
  Explorer explorer;
  std::vector<Vec2> way_W;
  ASSERT_TRUE(explorer.to_goal(grid, {0, 0}, {2, 0.1}, way_W));
  EXPECT_EQ(way_W.back().x, 2);
}

}  // namespace
}  // namespace rave::estimate
