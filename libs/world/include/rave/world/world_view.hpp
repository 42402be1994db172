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

/// A body of the world: obstacles first, in the order of the world file, then robots, then
/// obstacles that came while the run went. Never the number of another body, not even of one that
/// was removed.
using BodyId = Id<struct BodyTag>;

/// Something with a code on it that a landmark camera can read.
struct Landmark {
  BodyId body;
  std::int32_t code = 0;
  Vec2 p_WL;        ///< Its axis.
  double z0_m = 0;  ///< Height range of the printed code.
  double z1_m = 0;
  RobotId robot;        ///< Valid if a robot carries it.
  double radius_m = 0;  ///< Of the body that the code goes round; 0 if not known.
};

/// What a ray met.
struct RayHit {
  double range_m = std::numeric_limits<double>::infinity();
  BodyId body;  ///< Invalid if nothing was met.
};

/// Whether a robot touches anything.
struct TouchState {
  bool touching = false;
  Vec2 direction_W;  ///< Unit vector from the robot's centre towards the contact.
};

/// The world at one instant as virtual drivers see it; constant while they look. Poses are the true
/// ones of simulated robots and the reported ones of real robots. All in the world frame W. Calls
/// are allowed from many threads at once.
class WorldView {
 public:
  [[nodiscard]] virtual SimTime time() const noexcept = 0;
  [[nodiscard]] virtual std::uint32_t robot_count() const noexcept = 0;
  [[nodiscard]] virtual BodyId body_of(RobotId robot) const noexcept = 0;
  [[nodiscard]] virtual Pose2 pose(RobotId robot) const noexcept = 0;
  /// Velocity of the robot's origin over ground, axes of W.
  [[nodiscard]] virtual Twist2 velocity_W(RobotId robot) const noexcept = 0;
  [[nodiscard]] virtual Layer layer_of(BodyId body) const noexcept = 0;
  /// All landmarks, obstacles first, then robots, each at its present place.
  [[nodiscard]] virtual std::span<const Landmark> landmarks() const noexcept = 0;
  /// The nearest body of `layers` that a ray at height `z_m` meets. `bearing_rad` in W.
  /// `skip` is not seen (a robot never sees itself). O(bodies near the ray).
  [[nodiscard]] virtual RayHit cast(Vec2 p_W, double z_m, double bearing_rad, double range_max_m,
                                    LayerMask layers, BodyId skip) const noexcept = 0;
  /// Whether nothing of `layers` but `a` and `b` stands between two points at height `z_m`.
  [[nodiscard]] virtual bool visible(Vec2 p_from, Vec2 p_to, double z_m, LayerMask layers, BodyId a,
                                     BodyId b) const noexcept = 0;
  /// Robots whose origin is within `radius_m` of a point, ascending ids, at most `found.size()`;
  /// returns how many there are in all.
  [[nodiscard]] virtual std::uint32_t robots_within(Vec2 p_W, double radius_m,
                                                    std::span<RobotId> found) const noexcept = 0;
  [[nodiscard]] virtual TouchState touch(RobotId robot) const noexcept = 0;

 protected:
  ~WorldView() = default;
};

}  // namespace rave
