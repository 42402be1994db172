// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "rave/maps/global_map.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::maps {

/// The global map of each team, so that no team learns what another one has seen. It is called
/// `global`, or `global TEAM` if several teams make maps. A value; one thread at a time.
class TeamMaps {
 public:
  /// `teams`: by robot, its team; empty for a robot that makes no map.
  explicit TeamMaps(std::vector<std::string> teams);

  [[nodiscard]] const std::vector<std::string>& teams() const noexcept { return teams_; }
  /// Takes a tile; those of robots without a team and of global maps are ignored. Errors: those of
  /// GlobalMap::add().
  Status add(const MapTile& tile);
  /// The tiles of all global maps that changed since the last call.
  [[nodiscard]] std::vector<MapTile> changed();
  /// All tiles of the global map `name`; empty: there is none.
  [[nodiscard]] std::vector<MapTile> tiles(const std::string& name) const;

 private:
  std::vector<std::string> teams_;
  std::map<std::string, GlobalMap> maps_;  ///< By team.
};

/// The robots whose programs keep maps, for TeamMaps: of each robot its team (`robots` without
/// one), empty for the others.
[[nodiscard]] std::vector<std::string> mapping_teams(const sim::EngineSpec& spec);

}  // namespace rave::maps
