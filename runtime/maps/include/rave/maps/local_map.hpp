// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/estimate/robot_map.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/sim/engine.hpp"

namespace rave::maps {

/// The map of one robot, as tiles. If its program keeps a map, that one; otherwise one made here
/// beside the run, by the same rules (estimate::RobotMap), from all its range sensors and its
/// reported pose: only what the robot itself could know. One thread.
class LocalMap {
 public:
  /// Cells along each side of a map that is made here.
  static constexpr int kCells = estimate::RobotMap::kCells;

  /// Whether this engine runs the robot, and its program keeps a map, or it has a range sensor with
  /// known directions and a known reported pose.
  [[nodiscard]] static bool possible(const sim::Engine& engine, RobotId robot);
  /// Precondition: possible().
  LocalMap(const sim::Engine& engine, RobotId robot);

  [[nodiscard]] RobotId robot() const noexcept { return robot_; }
  /// Adds the new readings of a completed step.
  void follow(const sim::Engine& engine);
  /// Appends to `tiles` the tiles that changed since the last call, lowest row first.
  void put_changed(const sim::Engine& engine, std::vector<MapTile>& tiles);

 private:
  struct Told {
    std::uint32_t touched = 0;
    std::uint32_t revision = 0;
    std::vector<std::uint8_t> cells;
  };
  void add(std::uint32_t sensor, const sim::SensorSample& sample);
  [[nodiscard]] MapView view(const sim::Engine& engine) const;

  RobotId robot_;
  std::string name_;
  std::optional<estimate::RobotMap> own_;  ///< None: the program keeps a map.
  std::vector<std::uint32_t> sensors_;     ///< Indices of the sensors used.
  std::vector<std::uint32_t> sequences_;   ///< For each: sequence of its last sample in the map.
  std::vector<double> bearings_rad_;       ///< Memory of add().
  std::vector<Told> told_;                 ///< By row and column.
};

/// The cells of tile (`column`, `row`) of a map in percent; all are kUnknown: `known` is false.
[[nodiscard]] std::vector<std::uint8_t> tile_cells(const MapView& map, std::uint32_t column,
                                                   std::uint32_t row, bool& known);

}  // namespace rave::maps
