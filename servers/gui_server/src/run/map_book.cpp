// SPDX-License-Identifier: Apache-2.0
#include "run/map_book.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run/world_map.hpp"

namespace rave::gui_server {
namespace {

/// A robot has one local map, whatever a message calls it.
MapName key_of(const MapName& name) { return {name.slot, name.global() ? name.name : ""}; }

}  // namespace

MapBook::MapBook(const std::string& robots_json, const std::string& bodies_json) {
  std::uint32_t slot = 0;
  for (const auto& robot : nlohmann::json::parse(robots_json)) {
    const auto& sensors = robot.at("sensors");
    const bool ranges = std::any_of(sensors.begin(), sensors.end(), [](const auto& sensor) {
      return sensor.at("kind") == "ranges";
    });
    if (ranges) names_.push_back({slot, robot.at("name").template get<std::string>()});
    ++slot;
  }
  for (const maps::MapTile& tile : world_map(bodies_json)) add(tile);
}

void MapBook::add(const maps::MapTile& tile) {
  const MapName name{tile.robot, tile.source};
  const bool known = std::any_of(names_.begin(), names_.end(), [&name](const MapName& other) {
    return key_of(other) == key_of(name);
  });
  if (!known) {
    if (!name.global() || globals_ >= kMostGlobals) return;
    ++globals_;
    names_.push_back(name);
    ++names_revision_;
  }
  MapShown& map = maps_[key_of(name)];
  if (!(map.frame == tile.frame)) {
    // Another map of this name, such as of another host: the newer one counts.
    if (tile.stamp < map.stamp) return;
    tiles_ -= map.tiles.size();
    map = {tile.frame, tile.stamp, {}};
  }
  const std::pair place{tile.row, tile.column};
  if (!map.tiles.contains(place)) {
    if (tiles_ >= kMostTiles) return;
    ++tiles_;
  }
  TileShown& shown = map.tiles[place];
  if (shown.revision != 0 && tile.stamp < shown.stamp) return;
  shown = {++revision_, tile.stamp, tile.cells};
  map.stamp = std::max(map.stamp, tile.stamp);
}

const MapShown* MapBook::find(const MapName& name) const {
  const auto found = maps_.find(key_of(name));
  return found == maps_.end() ? nullptr : &found->second;
}

}  // namespace rave::gui_server
