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

/// The pose of a robot according to its own host.
struct RobotSight {
  RobotId robot;
  SimTime stamp;    ///< In the clock of the engine that receives it.
  Pose2 X_WR;       ///< Finite.
  Twist2 velocity;  ///< Body frame; finite.
};

/// Robot states as columns; a message refers to them without a copy. One owner thread.
class RobotColumns {
 public:
  void clear() noexcept;
  /// Adds a robot; ids must ascend. Stamps are in the clock of the run.
  void add(const RobotSight& sight);
  /// Adds a robot of an engine that has a pose: the pose at which it is sensed. `shift` is added to
  /// its stamp.
  void add(const sim::Engine& engine, RobotId robot, Duration shift);
  /// Makes the message refer to the columns; valid until this object changes.
  void lend(rave_wire_PlanarRobots& robots) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return id_.size(); }

 private:
  std::vector<std::uint32_t> id_;
  std::vector<double> x_m_, y_m_, yaw_rad_, vx_mps_, vy_mps_, wz_radps_;
  std::vector<std::int64_t> stamp_ns_;
};

/// The states that robots report, for monitors, as columns, which a message borrows. One owner
/// thread.
class ReportColumns {
 public:
  /// How long after its beginning a contact counts as lasting.
  static constexpr double kTouch_s = 0.5;

  /// Call it after each step, also if nothing is published, so that contacts are not missed.
  void note_contacts(const sim::Engine& engine);
  void clear() noexcept;
  /// Adds a robot of this engine; ids must ascend.
  void add(const sim::Engine& engine, RobotId robot);
  /// Makes the message refer to the columns; valid until this object changes.
  void lend(rave_wire_RobotReports& reports) noexcept;

 private:
  std::vector<std::uint32_t> id_;
  std::vector<double> x_m_, y_m_, yaw_rad_, variance_xy_m2_, variance_yaw_rad2_;
  std::vector<std::uint8_t> flags_;
  std::vector<double> touching_until_s_;  ///< By robot; empty before the first contact.
};

}  // namespace rave::lock_step
