// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/config/shape_file.hpp"
#include "rave/swarm/workload.hpp"

namespace rave::swarm {

inline constexpr double kRobotRadius_m = 0.15;
inline constexpr double kWallThickness_m = 0.2;

/// A rotated box on the floor of the arena.
struct Box {
  double length_m = 0;
  double width_m = 0;
  config::PoseFile pose;
};

/// Where everything stands at the start. The arena is a square about the origin; lengths are whole
/// millimetres and angles whole tenths of a degree, so that files stay short.
struct Arena {
  double side_m = 0;  ///< Between the inner faces of the walls.
  std::vector<Box> walls;
  std::vector<Box> boxes;  ///< Half as many as robots; clear of all robots.
  std::vector<config::PoseFile> robots;
};

/// A function of number and seed alone.
[[nodiscard]] Arena make_arena(std::uint32_t robots, std::uint64_t seed);

}  // namespace rave::swarm
