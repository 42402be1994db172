// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/local_map.hpp"

#include <cmath>
#include <set>

#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/maps/local_maps.hpp"

namespace rave::maps {
namespace {

using runtime::testing::kBody;
using runtime::testing::kWheels;
using runtime::testing::scenario_text;

const std::string kLaser =
    ", sensors: [{name: laser, driver: virtual_laser, period_s: 0.01, mount: {z_m: 0.1}, "
    "params: {rays: 181, fov_deg: 180, range_max_m: 3}}]";

std::string robot_at(const std::string& name, double x_m, const std::string& more = {}) {
  return fmt::format("  - {{name: {}, pose: {{x_m: {}, y_m: 0}}, robot: {{{}, {}{}}}}}\n", name,
                     x_m, kBody, kWheels, more);
}

/// What the newest tiles say of a place; kUnknown: nothing.
std::uint8_t cell_at(const std::vector<MapTile>& tiles, double x_m, double y_m) {
  std::uint8_t cell = kUnknown;
  for (const MapTile& tile : tiles) {
    const double cell_m = tile.frame.resolution_m;
    const auto x = static_cast<std::int64_t>(std::floor((x_m - tile.frame.origin_W.x) / cell_m));
    const auto y = static_cast<std::int64_t>(std::floor((y_m - tile.frame.origin_W.y) / cell_m));
    if (x / kTileCells != tile.column || y / kTileCells != tile.row) continue;
    cell = tile.cells[static_cast<std::size_t>(y % kTileCells) * kTileCells +
                      static_cast<std::size_t>(x % kTileCells)];
  }
  return cell;
}

class LocalMapTest : public ::testing::Test {
 protected:
  void start(const std::string& robots) {
    const std::string post =
        "obstacles: [{name: post, disc_radius_m: 0.2, x_m: 2, y_m: 0, z_m: [0, 1], "
        "layer: mapped_real}]\n";
    engine_ = host_.engine_of(scenario_text(robots, post));
    ASSERT_NE(engine_, nullptr);
    for (int k = 0; k < 3; ++k) step();
  }
  void step() { ASSERT_TRUE(engine_->step().has_value()); }

  runtime::testing::Host host_;
  std::unique_ptr<sim::Engine> engine_;
};

TEST_F(LocalMapTest, WhatALaserSeesIsFreeUpToWhereItEnds) {
  start(robot_at("a", 0, kLaser));
  ASSERT_TRUE(LocalMap::possible(*engine_, RobotId(0)));
  LocalMap map(*engine_, RobotId(0));
  for (int k = 0; k < 10; ++k) {
    step();
    map.follow(*engine_);
  }
  std::vector<MapTile> tiles;
  map.put_changed(*engine_, tiles);
  ASSERT_FALSE(tiles.empty());
  EXPECT_EQ(tiles.front().source, "a");
  EXPECT_EQ(tiles.front().robot, 0U);
  EXPECT_EQ(tiles.front().revision, 1U);
  EXPECT_DOUBLE_EQ(tiles.front().frame.resolution_m, 0.05);
  EXPECT_LT(cell_at(tiles, 1, 0.02), 20) << "free up to the post";
  EXPECT_GT(cell_at(tiles, 1.82, 0.02), 80) << "the near side of the post";
  EXPECT_EQ(cell_at(tiles, 2.4, 0.02), kUnknown) << "behind it";
  EXPECT_EQ(cell_at(tiles, -1, 0.02), kUnknown) << "behind the robot";
  EXPECT_LT(cell_at(tiles, 0.02, 1), 20) << "half of a beam without return";
  EXPECT_EQ(cell_at(tiles, 0.02, 2.5), kUnknown) << "the rest of it";
}

TEST_F(LocalMapTest, OnlyWhatChangedIsGivenAgain) {
  start(robot_at("a", 0, kLaser));
  LocalMap map(*engine_, RobotId(0));
  std::vector<MapTile> tiles;
  map.follow(*engine_);
  map.put_changed(*engine_, tiles);
  EXPECT_FALSE(tiles.empty());
  tiles.clear();
  // The same sample again is none.
  map.follow(*engine_);
  map.put_changed(*engine_, tiles);
  EXPECT_TRUE(tiles.empty());
  // After many scans from one place nothing changes any more.
  for (int k = 0; k < 30; ++k) {
    step();
    map.follow(*engine_);
  }
  map.put_changed(*engine_, tiles);
  EXPECT_FALSE(tiles.empty());
  EXPECT_EQ(tiles.front().revision, 2U);
  tiles.clear();
  for (int k = 0; k < 3; ++k) {
    step();
    map.follow(*engine_);
  }
  map.put_changed(*engine_, tiles);
  EXPECT_TRUE(tiles.empty());
}

TEST_F(LocalMapTest, MapsAreMadeOfWhatIsAskedForAlone) {
  start(robot_at("a", 0, kLaser) + robot_at("blind", -3) + robot_at("c", -6, kLaser));
  LocalMaps maps;
  maps.after_step(*engine_);
  EXPECT_TRUE(maps.empty());
  const std::vector<std::uint32_t> nobody{1, 7, 0xffffffff};
  maps.ask(*engine_, nobody);
  EXPECT_TRUE(maps.empty()) << "it sees nothing, or is not there";
  const std::vector<std::uint32_t> both{2, 2, 0};
  maps.ask(*engine_, both);
  const auto now = LocalMaps::Clock::now();
  const auto tiles = maps.changed(*engine_, now, 1);
  std::set<std::string> sources;
  for (const MapTile& tile : tiles) sources.insert(tile.source);
  EXPECT_EQ(sources, (std::set<std::string>{"a", "c"}));
  // Maps of several robots have tiles at the same places.
  for (const MapTile& tile : tiles) {
    const double tiles_off = tile.frame.origin_W.x / (kTileCells * tile.frame.resolution_m);
    EXPECT_NEAR(tiles_off, std::round(tiles_off), 1e-9);
  }
  step();
  maps.after_step(*engine_);
  EXPECT_TRUE(maps.changed(*engine_, now, 1).empty()) << "not yet";
  EXPECT_FALSE(maps.changed(*engine_, now + LocalMaps::kInterval, 1).empty());
}

TEST_F(LocalMapTest, AMapThatNobodyAsksForMakesRoomForAnother) {
  std::string robots;
  for (int i = 0; i <= static_cast<int>(LocalMaps::kMost); ++i) {
    robots += robot_at("r" + std::to_string(i), -5.0 * i, kLaser);
  }
  start(robots);
  LocalMaps maps;
  std::vector<std::uint32_t> asked;
  for (std::uint32_t i = 0; i <= LocalMaps::kMost; ++i) asked.push_back(i);
  maps.ask(*engine_, asked);
  EXPECT_EQ(maps.count(), LocalMaps::kMost);
  const auto now = LocalMaps::Clock::now();
  for (const MapTile& tile : maps.changed(*engine_, now, 1))
    EXPECT_LT(tile.robot, LocalMaps::kMost);
  const std::vector<std::uint32_t> last{LocalMaps::kMost};
  maps.ask(*engine_, last);
  EXPECT_EQ(maps.count(), LocalMaps::kMost);
  const auto tiles = maps.changed(*engine_, now + LocalMaps::kInterval, 1);
  ASSERT_FALSE(tiles.empty());
  EXPECT_EQ(tiles.front().robot, LocalMaps::kMost);
}

}  // namespace
}  // namespace rave::maps
