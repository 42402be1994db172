// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "rave/math/pose.hpp"
#include "rave/robot/actuator.hpp"

namespace rave::sim {

/// Speed over ground of a body velocity, m/s. Without a sideways part exactly |vx|.
[[nodiscard]] inline double speed_of(const Twist2& motion) noexcept {
  if (motion.vy == 0) return std::abs(motion.vx);
  return std::sqrt(motion.vx * motion.vx + motion.vy * motion.vy);
}

/// How the commands of one actuator become a motion of its robot, and back. A view of the instance
/// of its driver, which must outlive it. Functions are pure; any thread.
class ActuatorDrive {
 public:
  /// Goes forward and turns.
  ActuatorDrive() = default;
  ActuatorDrive(const DriveOps& ops, const void* instance) noexcept
      : ops_(ops.motion != nullptr ? &ops : nullptr), instance_(instance) {}

  /// It goes forward and turns, as commanded.
  [[nodiscard]] bool is_plain() const noexcept { return ops_ == nullptr; }
  /// Whether commands of this kind move the robot.
  [[nodiscard]] bool moves(CommandKind kind) const noexcept {
    return kind == CommandKind::kVelocity || !is_plain();
  }
  /// The motion that a command leads to; the command is of a kind that moves.
  [[nodiscard]] Twist2 motion(const Command& command) const noexcept {
    if (is_plain()) return {command.value[0], 0, command.value[1]};
    Twist2 motion;
    ops_->motion(instance_, &command, &motion);
    return motion;
  }
  /// The command that leads nearest to a motion.
  [[nodiscard]] Command command(const Twist2& motion) const noexcept {
    if (is_plain()) return velocity_command(motion.vx, motion.wz);
    Command command;
    ops_->command(instance_, &motion, &command);
    return command;
  }
  /// What makes the robot stand, for an actuator that takes commands of a kind; kNone: nothing
  /// does.
  [[nodiscard]] Command standing(CommandKind kind) const noexcept {
    return moves(kind) ? command({}) : Command{};
  }
  /// Of a measured velocity, what the drive does: a plain one that is measured to slide does not.
  [[nodiscard]] Twist2 own(const Twist2& measured) const noexcept {
    return is_plain() ? Twist2{measured.vx, 0, measured.wz} : measured;
  }

 private:
  const DriveOps* ops_ = nullptr;
  const void* instance_ = nullptr;
};

}  // namespace rave::sim
