// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "rave/estimate/occupancy_grid.hpp"

namespace rave::estimate {

/// A sample of a range sensor on a robot.
struct RangeSample {
  std::uint32_t sensor = 0;  ///< Index of the sensor.
  std::int64_t stamp_ns = 0;
  Pose2 X_RS;  ///< Mounting pose.
  double range_max_m = 0;
  double cone_rad = 0;  ///< Opening angle of a cone; 0 for rays.
  std::span<const double> bearings_rad;
  std::span<const float> ranges_m;  ///< One per bearing.
};

/// The map that a robot makes of its surroundings from all its range sensors and its pose. It is
/// centred on the first pose; readings outside are ignored. Cells are 0.05 m for sensors of up to
/// 8 m and 0.1 m beyond. Its frame is aligned to whole tiles of kTileCells cells, so that the maps
/// of several robots fit together. A beam without return marks half of its range as free, because a
/// surface farther away may reflect too little. A value; one thread at a time. Same input, same
/// bits.
class RobotMap {
 public:
  static constexpr int kCells = 512;  ///< Along each side.
  static constexpr int kTileCells = 64;
  static constexpr int kTiles = kCells / kTileCells;

  /// `longest_m`: the longest range of its sensors.
  RobotMap(Vec2 first_W, double longest_m);

  /// Remembers a pose, to find the one at the stamp of a reading. Call it in the order of stamps;
  /// one that is not newer is ignored.
  void follow(std::int64_t stamp_ns, const Pose2& X_WR);
  /// Adds a sample, at the remembered pose nearest to its stamp. Ignored before the first pose. A
  /// cone that a standing robot reads again is the same evidence and is not added twice.
  void add(const RangeSample& sample);

  [[nodiscard]] const OccupancyGrid& grid() const noexcept { return grid_; }
  /// Stamp of the newest sample; 0 before the first.
  [[nodiscard]] std::int64_t newest_ns() const noexcept { return newest_ns_; }
  /// For each tile, row by row: a number that grows when a sample may have changed it; 0: none has.
  [[nodiscard]] std::span<const std::uint32_t> touched() const noexcept { return touched_; }

 private:
  struct PoseAt {
    std::int64_t stamp_ns = 0;
    Pose2 X_WR;
  };
  /// The last cone that counted.
  struct LastCone {
    std::uint32_t sensor = 0;
    std::uint32_t index = 0;
    Pose2 X_WS;
    float range_m = 0;
  };
  [[nodiscard]] Pose2 pose_at(std::int64_t stamp_ns) const;
  void add_cones(const RangeSample& sample, const Pose2& X_WS);
  [[nodiscard]] bool is_news(const LastCone& cone);
  void touch(Vec2 p_W, double range_m);

  OccupancyGrid grid_;
  std::deque<PoseAt> poses_;  ///< The last poses, oldest first.
  std::vector<LastCone> cones_;
  std::int64_t newest_ns_ = 0;
  std::uint32_t samples_ = 0;
  std::vector<std::uint32_t> touched_;
};

}  // namespace rave::estimate
