// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rave::config {

/// An interval of heights above the floor, metres: low, high; low < high.
using HeightRange = std::array<double, 2>;

/// The outline of a body seen from above; exactly one member is set.
struct Outline {
  std::optional<double> disc_radius_m;  ///< Greater than 0.
  /// Full length along x and full width along y, centred; both greater than 0.
  std::optional<std::array<double, 2>> box_m;
  /// Corners in order, clockwise or counter-clockwise, at least 3; no edge crosses another; may be
  /// concave.
  std::optional<std::vector<std::array<double, 2>>> polygon_m;
  bool operator==(const Outline&) const = default;
};

/// One upright prism of a robot's body, in the body frame.
struct ShapeFile {
  Outline outline;
  std::array<double, 2> centre_m{};  ///< Origin of the outline in the body frame.
  double yaw_deg = 0;                ///< Rotation of the outline about its origin.
  HeightRange z_m{0, 0.5};
  bool operator==(const ShapeFile&) const = default;
};

/// A pose on the floor.
struct PoseFile {
  double x_m = 0;
  double y_m = 0;
  double yaw_deg = 0;
  bool operator==(const PoseFile&) const = default;
};

/// Layers that a body of the world file can belong to.
enum class ObstacleLayer { kVirtualObstacles, kMappedReal };

/// Layers that a sensor can sense.
enum class SensedLayer { kVirtualObstacles, kMappedReal, kSimulatedRobots, kRealRobots };

}  // namespace rave::config
