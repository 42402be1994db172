// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/local_maps.hpp"

#include <algorithm>

namespace rave::maps {

void LocalMaps::ask(const sim::Engine& engine, std::span<const std::uint32_t> robots) {
  for (const std::uint32_t robot : robots) {
    const bool begun = std::ranges::any_of(
        maps_, [robot](const auto& map) { return map->robot().value() == robot; });
    if (begun || !LocalMap::possible(engine, RobotId(robot))) continue;
    if (maps_.size() >= kMost) {
      // A map that no monitor requests any more is replaced.
      const auto idle = std::ranges::find_if(maps_, [robots](const auto& map) {
        return std::ranges::find(robots, map->robot().value()) == robots.end();
      });
      if (idle == maps_.end()) return;
      maps_.erase(idle);
    }
    maps_.push_back(std::make_unique<LocalMap>(engine, RobotId(robot)));
    // The first tiles of a new map are sent at once.
    maps_.back()->follow(engine);
    next_ = {};
  }
}

void LocalMaps::after_step(const sim::Engine& engine) {
  for (const auto& map : maps_) map->follow(engine);
}

std::vector<MapTile> LocalMaps::changed(const sim::Engine& engine, Clock::time_point now,
                                        int slower) {
  std::vector<MapTile> tiles;
  if (maps_.empty() || now < next_) return tiles;
  next_ = now + kInterval * slower;
  for (const auto& map : maps_) map->put_changed(engine, tiles);
  return tiles;
}

}  // namespace rave::maps
