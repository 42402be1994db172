// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "rave/base/ids.hpp"
#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/world/layer.hpp"

namespace rave {

/// The id of a body: obstacles first, in the order of the world file, then robots, then obstacles
/// added during the run. Ids are never reused, not even those of removed obstacles.
using BodyId = Id<struct BodyTag>;

/// A barcode that a landmark camera can read.
struct Landmark {
  BodyId body;
  std::int32_t code = 0;
  Vec2 p_WL;        ///< Position of its axis.
  double z0_m = 0;  ///< Height range of the printed code.
  double z1_m = 0;
  RobotId robot;        ///< Valid if a robot carries it.
  double radius_m = 0;  ///< Radius of the body that carries the code; 0 if unknown.
};

/// The result of a ray cast.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();
  BodyId body;  ///< Invalid without a hit.
};

/// Whether a robot touches anything, and where.
struct TouchState {
  bool touching = false;
  Vec2 direction_W;  ///< Unit vector from the robot's centre towards the contact.
};

/// The world at one time for virtual drivers; constant during their calls. Poses are the true ones
/// of simulated robots and the reported ones of real robots. Everything is in the world frame W.
/// Thread-safe.
class WorldView {
 public:
  [[nodiscard]] virtual SimTime time() const noexcept = 0;
  [[nodiscard]] virtual std::uint32_t robot_count() const noexcept = 0;
  [[nodiscard]] virtual BodyId body_of(RobotId robot) const noexcept = 0;
  [[nodiscard]] virtual Pose2 pose(RobotId robot) const noexcept = 0;
  /// Velocity of the robot's origin over ground, in the axes of W.
  [[nodiscard]] virtual Twist2 velocity_W(RobotId robot) const noexcept = 0;
  [[nodiscard]] virtual Layer layer_of(BodyId body) const noexcept = 0;
  /// All landmarks at their present places, those of obstacles first.
  [[nodiscard]] virtual std::span<const Landmark> landmarks() const noexcept = 0;
  /// The nearest body of `layers` that a ray at height `z_m` hits. `bearing_rad` is in W. Body
  /// `skip` is ignored (a robot never senses itself). Cost: the number of bodies near the ray.
  [[nodiscard]] virtual RayHit cast(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                                    LayerMask layers, BodyId skip) const noexcept = 0;
  /// Whether no body of `layers` except `a` and `b` is between two points at height `z_m`.
  [[nodiscard]] virtual bool visible(Vec2 p_from, Vec2 p_to, double z_m, LayerMask layers, BodyId a,
                                     BodyId b) const noexcept = 0;
  /// Writes the ids of robots whose origin is within `radius_m` of a point, ascending, at most
  /// `found.size()`; returns their total number.
  [[nodiscard]] virtual std::uint32_t robots_within(Vec2 p_W, double radius_m,
                                                    std::span<RobotId> found) const noexcept = 0;
  [[nodiscard]] virtual TouchState touch(RobotId robot) const noexcept = 0;

 protected:
  ~WorldView() = default;
};

}  // namespace rave
