// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/topics.hpp"
#include "rave/math/pose.hpp"
#include "rave/sim/engine.hpp"

namespace rave::lock_step {

/// Where a robot was, as its own host said.
struct RobotSight {
  RobotId robot;
  SimTime stamp;    ///< By the clock of the engine that shall know it.
  Pose2 X_WR;       ///< Finite.
  Twist2 velocity;  ///< Body frame; finite.
};

/// Robots in the plane, in the columns that a message borrows. One owner thread.
class RobotColumns {
 public:
  void clear() noexcept;
  /// Behind those with lower numbers. Stamps by the clock of the run.
  void add(const RobotSight& sight);
  /// The same of a robot of an engine that is somewhere: where it is sensed. `shift` is put on its
  /// stamp.
  void add(const sim::Engine& engine, RobotId robot, Duration shift);
  /// The message holds until this object changes.
  void lend(rave_wire_PlanarRobots& robots) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return id_.size(); }

 private:
  std::vector<std::uint32_t> id_;
  std::vector<double> x_m_, y_m_, yaw_rad_, vx_mps_, vy_mps_, wz_radps_;
  std::vector<std::int64_t> stamp_ns_;
};

}  // namespace rave::lock_step
