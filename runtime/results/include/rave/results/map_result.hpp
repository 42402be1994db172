// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rave/maps/map_tile.hpp"
#include "rave/results/facts.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// A map against the obstacles of the world model at the end of the run.
struct MapAccuracy {
  std::string name;          ///< Of the robot; `global` for all.
  std::size_t free = 0;      ///< Cells that the map says are free (less than 35 %).
  std::size_t occupied = 0;  ///< Cells that it says are occupied (more than 65 %).
  std::size_t undecided = 0;
  std::size_t unknown = 0;         ///< Cells of its tiles of which it says nothing.
  std::size_t free_right = 0;      ///< Of the free ones: those that no obstacle covers.
  std::size_t occupied_right = 0;  ///< Of the occupied ones: those with an obstacle within 0.1 m.
  double wall_error_m = 0;  ///< Mean distance of occupied cells from obstacles, each at most 0.5 m.
  double known_m2 = 0;
};

struct MapResults {
  double cell_m = 0;
  std::vector<MapAccuracy> locals;    ///< By robot.
  std::optional<MapAccuracy> global;  ///< Their combination; none if they cannot be combined.
  std::string problem;                ///< Why not.
  /// The tiles of each map, the global one last.
  std::vector<std::vector<maps::MapTile>> tiles;
};

/// The accuracy of the maps that programs kept; none if there are none.
[[nodiscard]] std::optional<MapResults> map_results(const sim::EngineSpec& spec,
                                                    const RunFacts& facts);

}  // namespace rave::runtime
