// SPDX-License-Identifier: Apache-2.0
#include "start_poses.hpp"

#include "rave/math/trigonometry.hpp"

namespace rave::config {
namespace {

/// The least whole number whose square is not below `count`.
std::size_t side_of(std::size_t count) noexcept {
  std::size_t side = 1;
  while (side * side < count) ++side;
  return side;
}

PoseFile place(const GridFile& grid, std::size_t i) {
  const std::size_t columns = grid.columns ? static_cast<std::size_t>(*grid.columns)
                                           : side_of(static_cast<std::size_t>(grid.count));
  return {grid.x_m + static_cast<double>(i % columns) * grid.step_m,
          grid.y_m + static_cast<double>(i / columns) * grid.step_m, grid.yaw_deg};
}

PoseFile place(const RingFile& ring, std::size_t i) {
  const double angle_deg = 360.0 * static_cast<double>(i) / ring.count;
  const SinCos direction = sincos(angle_deg * kPi / 180);
  // Within what a pose may have, also when it is written and read again.
  double yaw_deg = angle_deg < 180 ? angle_deg : angle_deg - 360;
  if (ring.facing == RingFacing::kIn) yaw_deg += 180;
  if (ring.facing == RingFacing::kAlong) yaw_deg += 90;
  return {ring.x_m + ring.radius_m * direction.cos, ring.y_m + ring.radius_m * direction.sin,
          yaw_deg};
}

}  // namespace

std::size_t robots_of(const RobotEntry& entry) noexcept {
  if (entry.poses) return entry.poses->size();
  if (entry.grid) return static_cast<std::size_t>(entry.grid->count);
  if (entry.ring) return static_cast<std::size_t>(entry.ring->count);
  return entry.scatter ? static_cast<std::size_t>(entry.scatter->count) : 1;
}

std::optional<PoseFile> pose_of(const RobotEntry& entry, std::size_t i) {
  if (entry.grid) return place(*entry.grid, i);
  if (entry.ring) return place(*entry.ring, i);
  if (!entry.poses) return entry.pose;
  const auto& [x_m, y_m, yaw_deg] = (*entry.poses)[i];
  return PoseFile{x_m, y_m, yaw_deg};
}

}  // namespace rave::config
