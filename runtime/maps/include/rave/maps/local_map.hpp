// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "rave/estimate/occupancy_grid.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/sim/engine.hpp"

namespace rave::maps {

/// The occupancy grid of one robot from all its range sensors and its reported pose: only what the
/// robot itself could know. It is centred on the pose of the robot at creation; readings outside
/// are ignored. Cells are 0.05 m for sensors of up to 8 m, and 0.1 m beyond. For a cone the axis is
/// used. A beam without return marks half of its range as free, because a surface farther away may
/// reflect too little. One thread.
class LocalMap {
 public:
  /// Cells along each side.
  static constexpr int kCells = 512;

  /// Whether this engine runs the robot, and it has a range sensor with known directions and a
  /// known reported pose.
  [[nodiscard]] static bool possible(const sim::Engine& engine, RobotId robot);
  /// Precondition: possible().
  LocalMap(const sim::Engine& engine, RobotId robot);

  [[nodiscard]] RobotId robot() const noexcept { return robot_; }
  /// Adds the new readings of a completed step.
  void follow(const sim::Engine& engine);
  /// Appends to `tiles` the tiles that changed since the last call, lowest row first.
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
  std::vector<std::uint32_t> sensors_;    ///< Indices of the sensors used.
  std::vector<std::uint32_t> sequences_;  ///< For each: sequence of its last sample in the map.
  std::vector<double> bearings_rad_;      ///< Memory of add().
  std::deque<PoseAt> poses_;              ///< The last poses, oldest first.
  std::int64_t newest_ns_ = 0;
  /// The tiles that may have changed since the last put_changed(); empty if the first is larger.
  std::int64_t column0_ = 0, column1_ = -1, row0_ = 0, row1_ = -1;
  std::vector<Told> told_;  ///< By row and column.
};

}  // namespace rave::maps
