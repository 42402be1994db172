// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/robot/command.hpp"
#include "rave/world/body.hpp"

namespace rave::sim {

/// What a robot does when the virtual world stops coming: a frozen wall must not read as free.
enum class WorldLostPolicy : std::uint8_t { kStop, kSlow, kIgnore };

/// Limits below program and controllers that neither can pass. SI units; frame W.
struct GuardSpec {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  bool arm = false;                  ///< A real robot stands until it is armed.
  double max_speed_mps = kNoLimit;   ///< Either way.
  double max_turn_radps = kNoLimit;  ///< Either way.
  /// Corners of a simple polygon, either sense of rotation; empty: no fence.
  std::vector<Vec2> fence_W;
  double separation_m = -1;  ///< Least distance to the bodies of other robots; below 0: not kept.
  WorldLostPolicy world_lost = WorldLostPolicy::kStop;
  double world_timeout_s = 0.5;    ///< Age of the virtual world after which it counts as lost.
  double slow_speed_mps = 0.05;    ///< Largest speed while it is lost, for kSlow.
  double deceleration_mps2 = 0.5;  ///< What the robot surely brakes with; above 0.
  double reaction_s = 0.1;         ///< From a command until the robot obeys.
  double watchdog_s = 1.0;         ///< A program's command older than this is no command.
};

/// Why a command did not reach an actuator as it was given.
enum class GuardLimit : std::uint32_t {
  kStopped,     ///< Somebody stopped the robot; latched.
  kUnarmed,     ///< Nobody has armed it yet.
  kPoseLost,    ///< Where it is is not known (any more).
  kSensorLost,  ///< A sensor of the robot has fallen silent or its device is gone.
  kWorldLost,   ///< The virtual world does not come any more.
  kWatchdog,    ///< The program gives no commands any more.
  kBadCommand,  ///< Not a number, or of a kind that cannot be guarded.
  kSpeed,
  kTurn,
  kFence,
  kSeparation,
};
inline constexpr std::size_t kGuardLimits = 11;
/// One word, such as `fence`.
[[nodiscard]] std::string_view to_string(GuardLimit limit) noexcept;
/// Whether a limit makes the robot stand, rather than slow down.
[[nodiscard]] constexpr bool stops(GuardLimit limit) noexcept {
  return limit <= GuardLimit::kBadCommand;
}

/// Another robot as the guard knows it.
struct GuardNeighbour {
  const world::Body* body = nullptr;
  Pose2 X_WB;
  Twist2 velocity_W;
};

/// A sensor that must not fall silent while the robot drives.
struct GuardSensor {
  std::uint32_t index = 0;  ///< Of the sensor in its robot's type.
  double age_s = 0;         ///< Since its newest sample came; infinite: none yet, or it is gone.
  double max_age_s = 0;
};

/// What the guard of one robot knows in one step.
struct GuardInput {
  Command command;                                ///< What the controller gives.
  CommandKind expected = CommandKind::kVelocity;  ///< What the actuator takes.
  double command_age_s = 0;                       ///< Since the program gave one; infinite: never.
  bool stopped = false;
  bool armed = true;
  bool pose_known = true;  ///< The reported pose is there and fresh.
  Pose2 X_WR;              ///< Reported.
  double pose_age_s = 0;
  SimTime pose_stamp;      ///< By any clock: another one says that this pose is another.
  Twist2 velocity;         ///< Reported, body frame.
  double fastest_mps = 0;  ///< Either way, of what it was told since that pose was taken.
  std::span<const GuardSensor> sensors;
  double world_age_s = 0;
  double dt_s = 0.01;
  /// Something limited the last motion, or did before the robot was made to stand there: the next
  /// one may slide along it.
  bool touching = false;
  double radius_m = 0;  ///< Of the disc about the robot's origin that holds its body; above 0.
  const world::Body* body = nullptr;
  std::span<const GuardNeighbour> neighbours;  ///< Those within guard_reach_m().
};

struct GuardOutput {
  Command command;
  std::uint32_t lost_sensor = 0;  ///< For kSensorLost: index of the first one that is too old.
  std::uint32_t acted = 0;        ///< Bit `1 << limit` of each limit that changed the command.

  [[nodiscard]] bool by(GuardLimit limit) const noexcept {
    return (acted >> static_cast<std::uint32_t>(limit) & 1U) != 0;
  }
};

/// How far from the outline's disc of a robot another one must be for the separation not to matter
/// in this step. Infinite commands and speeds are bounded.
[[nodiscard]] double guard_reach_m(const GuardSpec& spec, const GuardInput& input) noexcept;

/// Limits one command. Pure: the same input gives the same bits; any thread; no allocation.
/// Formulas and assumptions: docs/explanation/guard.md.
///
/// Velocities are limited; `kJoint` and `kValues` pass if they are finite and nothing holds the
/// robot, else the actuator gets nothing; `kGoal` is never passed on, since the way to it is the
/// actuator's own.
[[nodiscard]] GuardOutput guard(const GuardSpec& spec, const GuardInput& input) noexcept;

}  // namespace rave::sim
