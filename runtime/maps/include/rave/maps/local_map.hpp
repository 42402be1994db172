// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "rave/estimate/occupancy_grid.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/sim/engine.hpp"

namespace rave::maps {

/// The occupancy grid of one robot, from all of its range sensors and its reported pose: what the
/// robot itself could know. It lies around the place where the robot was when it was begun; what is
/// outside is left out. Cells are 0.05 m for sensors of up to 8 m, and 0.1 m beyond. Of a cone the
/// axis counts. A beam without return counts as free over half of its range: farther away a surface
/// may reflect too little. One thread.
class LocalMap {
 public:
  /// Cells along each side.
  static constexpr int kCells = 512;

  /// Whether the robot runs at this engine, has a range sensor whose directions are known, and has
  /// said where it is.
  [[nodiscard]] static bool possible(const sim::Engine& engine, RobotId robot);
  /// A programmer's mistake unless possible().
  LocalMap(const sim::Engine& engine, RobotId robot);

  [[nodiscard]] RobotId robot() const noexcept { return robot_; }
  /// A step is done: takes new readings in.
  void follow(const sim::Engine& engine);
  /// Puts the tiles behind `tiles` that changed since the last call, lowest row first.
  void put_changed(std::vector<MapTile>& tiles);

 private:
  struct PoseAt {
    std::int64_t stamp_ns = 0;
    Pose2 X_WR;
  };
  struct Told {
    std::uint32_t revision = 0;
    std::vector<std::uint8_t> cells;
  };
  [[nodiscard]] Pose2 pose_at(std::int64_t stamp_ns) const;
  void add(const sim::SensorSample& sample);
  void touch(Vec2 p_W, double range_m);
  [[nodiscard]] std::vector<std::uint8_t> cells_of(std::uint32_t column, std::uint32_t row,
                                                   bool& known) const;

  RobotId robot_;
  std::string name_;
  MapFrame frame_;
  estimate::OccupancyGrid grid_;
  std::vector<std::uint32_t> sensors_;    ///< Indices of those that are used.
  std::vector<std::uint32_t> sequences_;  ///< Of each: of the sample that was taken in last.
  std::vector<double> bearings_rad_;      ///< Memory of add().
  std::deque<PoseAt> poses_;              ///< The last ones, oldest first.
  std::int64_t newest_ns_ = 0;
  /// What may have changed since the last put_changed(), in tiles; empty if the first is larger.
  std::int64_t column0_ = 0, column1_ = -1, row0_ = 0, row1_ = -1;
  std::vector<Told> told_;  ///< By row and column.
};

}  // namespace rave::maps
