// SPDX-License-Identifier: Apache-2.0
// Three robots map a building: what their maps, and the global one, are worth.
#include <fstream>
#include <nlohmann/json.hpp>

#include "rave/maps/local_map.hpp"
#include "rave/maps/team_maps.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class Mapping : public ScenarioTest {
 protected:
  nlohmann::json result() const {
    std::ifstream file(folder_ / "result.json");
    return nlohmann::json::parse(file);
  }
};

TEST_F(Mapping, TheMapsAreRight) {
  const auto outcome = run(load("collaborative-mapping"));
  EXPECT_TRUE(outcome.whole);
  EXPECT_TRUE(outcome.checks_hold) << outcome.summary;
  const auto maps = result()["maps"];
  ASSERT_EQ(maps["robots"].size(), 3U);
  double known_m2 = 0;
  for (const auto& [name, map] : maps["robots"].items()) {
    EXPECT_GT(map["known_m2"], 40) << name;
    EXPECT_GT(map["free_right_pct"], 95) << name;
    known_m2 = std::max(known_m2, map["known_m2"].get<double>());
  }
  const auto& global = maps["global"];
  EXPECT_GT(global["known_m2"], 1.2 * known_m2) << "together they know more";
  EXPECT_GT(global["free_right_pct"], 97);
  EXPECT_GT(global["occupied_right_pct"], 80);
  EXPECT_LT(global["wall_error_m"], 0.1);
  for (const char* const map : {"global", "patton", "rommel", "de-gaulle"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "maps" / (std::string(map) + ".pgm"))) << map;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "maps" / (std::string(map) + ".yaml"))) << map;
  }
}

TEST_F(Mapping, TheGlobalMapIsTheCombinationOfTheLocalsCellByCell) {
  const auto world = make_world(load("collaborative-mapping"));
  ASSERT_TRUE(world.engine);
  world.run_until(40);
  maps::TeamMaps teams(maps::mapping_teams(world.engine->spec()));
  std::map<std::pair<long, long>, std::vector<std::uint8_t>> locals;
  const auto each_cell = [](const maps::MapTile& tile, const auto& act) {
    for (std::uint32_t i = 0; i < tile.cells.size(); ++i) {
      const double x = tile.column * maps::kTileCells + i % maps::kTileCells;
      const double y = tile.row * maps::kTileCells + i / maps::kTileCells;
      act(std::pair{std::lround(tile.frame.origin_W.x / tile.frame.resolution_m + x),
                    std::lround(tile.frame.origin_W.y / tile.frame.resolution_m + y)},
          tile.cells[i]);
    }
  };
  for (std::uint32_t robot = 0; robot < 3; ++robot) {
    ASSERT_NE(world.engine->program_map(RobotId(robot)).log_odds, nullptr);
    maps::LocalMap local(*world.engine, RobotId(robot));
    std::vector<maps::MapTile> tiles;
    local.put_changed(*world.engine, tiles);
    ASSERT_FALSE(tiles.empty());
    for (const maps::MapTile& tile : tiles) {
      ASSERT_TRUE(teams.add(tile));
      each_cell(tile, [&](const auto& where, std::uint8_t cell) { locals[where].push_back(cell); });
    }
  }
  std::size_t compared = 0;
  std::size_t shared = 0;
  for (const maps::MapTile& tile : teams.tiles("global")) {
    each_cell(tile, [&](const auto& where, std::uint8_t cell) {
      EXPECT_EQ(cell, maps::combined(locals.at(where))) << where.first << ", " << where.second;
      ++compared;
      shared += static_cast<std::size_t>(
          std::ranges::count_if(locals.at(where), [](int c) { return c != maps::kUnknown; }) > 1);
    });
  }
  EXPECT_EQ(compared, locals.size());
  EXPECT_GT(shared, 100U) << "some cells are known to two robots";
}

TEST_F(Mapping, MapsArePartOfTheHash) {
  const auto hash_of = [this](int threads, bool isolated) {
    auto scenario = load("collaborative-mapping");
    scenario.scenario.threads = threads;
    for (config::RobotGroup& group : scenario.groups) group.robot.program->isolate = isolated;
    const auto world = make_world(scenario);
    if (world.engine) world.run_until(10);
    return world.engine ? world.engine->hash().value() : 0;
  };
  const std::uint64_t hash = hash_of(1, false);
  EXPECT_NE(hash, 0U);
  EXPECT_EQ(hash_of(3, false), hash);
  EXPECT_EQ(hash_of(1, true), hash);
}

}  // namespace
}  // namespace rave::tests
