// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "rave/math/transform.hpp"
#include "rave/robot/scan.hpp"

namespace rave {

/// Where obstacles were seen lately: a small grid that moves with the robot, so that a robot with
/// three sonars still knows the wall beside it. A cell is set by a return, and cleared by a beam
/// that passes through it or by time. The idea is the histogram grid of J. Borenstein, Y. Koren,
/// "The vector field histogram", IEEE Trans. Robotics and Automation 7(3), 1991.
class ObstacleMemory {
 public:
  /// Cells per side and their size: the grid covers 6.4 m by 6.4 m about the robot.
  static constexpr int kSide = 64;
  static constexpr double kCell_m = 0.1;

  explicit ObstacleMemory(Duration keep = from_seconds(20)) : keep_(keep) {}

  /// Takes one scan at the pose it was seen from.
  void update(const Scan& scan, const Pose2& X_WR, SimTime now) {
    now_ = now;
    for (const RangeBeam& beam : scan.beams()) sweep(beam, X_WR);
    for (const RangeHit& hit : scan.hits()) {
      // Blindness ends; it is nothing to remember.
      if (!hit.blind && hit.distance_m < 0.45 * kSide * kCell_m) mark(transform(X_WR, hit.p_R));
    }
  }

  /// Appends the remembered points within reach_m of the robot, in its frame.
  void append_to(std::vector<Vec2>& points_R, const Pose2& X_WR, double reach_m) const {
    for (const Cell& cell : cells_) {
      if (!alive(cell)) continue;
      const Vec2 p_R = transform_back(X_WR, cell.p_W);
      if (squared_norm(p_R) < reach_m * reach_m) points_R.push_back(p_R);
    }
  }

  void forget() { cells_.fill({}); }

 private:
  struct Cell {
    Vec2 p_W;                   ///< The exact point of the last return in it.
    std::int64_t seen_ns = -1;  ///< Never, if negative.
  };

  static std::int64_t index_of(double metres) {
    return static_cast<std::int64_t>(std::floor(metres / kCell_m));
  }
  /// Far cells share memory with near ones; who was written last counts.
  Cell& at(Vec2 p_W) {
    const auto column = static_cast<std::size_t>(index_of(p_W.x) & (kSide - 1));
    const auto row = static_cast<std::size_t>(index_of(p_W.y) & (kSide - 1));
    return cells_[row * kSide + column];
  }
  bool alive(const Cell& cell) const {
    return cell.seen_ns >= 0 && now_.ns - cell.seen_ns <= keep_.ns;
  }
  void mark(Vec2 p_W) { at(p_W) = {p_W, now_.ns}; }

  /// Clears what stands where the beam saw nothing, short of the return by a cell and a half.
  void sweep(const RangeBeam& beam, const Pose2& X_WR) {
    const double end_m = std::min(beam.free_m, 0.45 * kSide * kCell_m) - 1.5 * kCell_m;
    for (double s_m = kCell_m; s_m < end_m; s_m += 0.5 * kCell_m) {
      const Vec2 p_W = transform(X_WR, beam.origin_R + s_m * beam.direction_R);
      Cell& cell = at(p_W);
      if (cell.seen_ns < now_.ns && squared_norm(cell.p_W - p_W) < kCell_m * kCell_m) cell = {};
    }
  }

  Duration keep_;
  SimTime now_;
  std::array<Cell, kSide * kSide> cells_{};
};

}  // namespace rave
