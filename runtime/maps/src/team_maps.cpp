// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/team_maps.hpp"

namespace rave::maps {

TeamMaps::TeamMaps(std::vector<std::string> teams) : teams_(std::move(teams)) {
  for (const std::string& team : teams_) {
    if (!team.empty()) maps_.try_emplace(team);
  }
  for (auto& [team, map] : maps_) {
    map = GlobalMap(maps_.size() == 1 ? "global" : "global " + team);
  }
}

Status TeamMaps::add(const MapTile& tile) {
  if (tile.robot >= teams_.size()) return {};
  const auto map = maps_.find(teams_[tile.robot]);
  return map == maps_.end() ? Status() : map->second.add(tile);
}

std::vector<MapTile> TeamMaps::changed() {
  std::vector<MapTile> tiles;
  for (auto& [team, map] : maps_) {
    for (MapTile& tile : map.changed()) tiles.push_back(std::move(tile));
  }
  return tiles;
}

std::vector<MapTile> TeamMaps::tiles(const std::string& name) const {
  for (const auto& [team, map] : maps_) {
    if (map.name() == name) return map.tiles();
  }
  return {};
}

std::vector<std::string> mapping_teams(const sim::EngineSpec& spec) {
  std::vector<std::string> teams(spec.robots.size());
  for (std::size_t r = 0; r < teams.size(); ++r) {
    const auto& program = spec.types[spec.robots[r].type].program;
    if (!program || program->ops == nullptr || program->ops->map == nullptr) continue;
    teams[r] = spec.robots[r].team.empty() ? "robots" : spec.robots[r].team;
  }
  return teams;
}

}  // namespace rave::maps
