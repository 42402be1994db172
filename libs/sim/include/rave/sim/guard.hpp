// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/sight.hpp"
#include "rave/sim/drive.hpp"
#include "rave/world/body.hpp"

namespace rave::sim {

/// What a robot does when no world messages arrive: a virtual wall may have moved meanwhile.
enum class WorldLostPolicy : std::uint8_t { kStop, kSlow, kIgnore };

/// Limits that neither program nor controllers can exceed. SI units; frame W.
struct GuardSpec {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();

  bool arm = false;                  ///< A real robot does not move before it is armed.
  double max_speed_mps = kNoLimit;   ///< In either direction.
  double max_turn_radps = kNoLimit;  ///< In either direction.
  /// Corners of a simple polygon, clockwise or counter-clockwise; empty: no fence.
  std::vector<Vec2> fence_W;
  double separation_m = -1;  ///< Least distance to the bodies of other robots; negative: no limit.
  WorldLostPolicy world_lost = WorldLostPolicy::kStop;
  double world_timeout_s = 0.5;    ///< Age of the virtual world after which it counts as lost.
  double slow_speed_mps = 0.05;    ///< Largest speed while it is lost, for kSlow.
  double deceleration_mps2 = 0.5;  ///< The deceleration that the robot achieves at least; above 0.
  double reaction_s = 0.1;         ///< Delay between a command and its effect.
  double watchdog_s = 1.0;  ///< Commands of the program that are older than this are ignored.
  /// Real robots: on top of `reaction_s`, how long a sensor may repeat itself to the bit while the
  /// robot is commanded to move; 0: for ever.
  double frozen_s = 0.5;
  /// Real robots: half of the angle that its range sensors must see where it drives; 0: none.
  double must_see_rad = kMustSee_rad;
};

/// Why a command did not reach an actuator unchanged.
enum class GuardLimit : std::uint32_t {
  kStopped,     ///< The robot was stopped; latched.
  kUnarmed,     ///< It has not been armed.
  kPoseLost,    ///< Its pose is unknown, or not known any more.
  kSensorLost,  ///< A sensor of the robot has fallen silent, or its device is lost.
  kWorldLost,   ///< World messages do not arrive any more.
  kWatchdog,    ///< The program has stopped giving commands.
  kBadCommand,  ///< Not finite, or of a kind that cannot be guarded.
  kSpeed,
  kTurn,
  kFence,
  kSeparation,
  // In the order in which they came, because recordings have the numbers.
  kFrozen,  ///< A sensor repeats itself although the robot was told to move.
  kBlind,   ///< Its range sensors do not see where it would drive.
};
inline constexpr std::size_t kGuardLimits = 13;
/// The name of a limit, such as `fence`.
[[nodiscard]] std::string_view to_string(GuardLimit limit) noexcept;
/// Whether a limit stops the robot instead of slowing it down.
[[nodiscard]] constexpr bool stops(GuardLimit limit) noexcept {
  return limit <= GuardLimit::kBadCommand || limit == GuardLimit::kFrozen;
}

/// Another robot near the guarded one.
struct GuardNeighbour {
  const world::Body* body = nullptr;
  Pose2 X_WB;
  Twist2 velocity_W;
};

/// A sensor that must deliver samples while the robot drives.
struct GuardSensor {
  std::uint32_t index = 0;  ///< Index of the sensor in the robot's type.
  double age_s = 0;  ///< Time since its newest sample; infinite: none yet, or the device is lost.
  double max_age_s = 0;
};

/// The input of one robot's guard in one step.
struct GuardInput {
  Command command;                                ///< Command of the controller.
  CommandKind expected = CommandKind::kVelocity;  ///< The kind that the controller gives.
  ActuatorDrive drive;                            ///< What the actuator makes of commands.
  double command_age_s = 0;  ///< Age of the program's last command; infinite: none yet.
  bool stopped = false;
  bool armed = true;
  bool pose_known = true;  ///< A fresh reported pose is available.
  Pose2 X_WR;              ///< Reported pose.
  double pose_age_s = 0;
  /// Stamp of the pose in any clock; a different stamp means a different pose.
  SimTime pose_stamp;
  Twist2 velocity;  ///< Reported velocity, body frame.
  /// Largest speed, in either direction, commanded since the pose was measured.
  double fastest_mps = 0;
  std::span<const GuardSensor> sensors;
  /// Index of a sensor that repeats itself, in the robot's type.
  std::optional<std::uint32_t> frozen_sensor;
  bool is_blind_ahead = false;   ///< Its range sensors do not see where it would drive...
  bool is_blind_behind = false;  ///< ... or would back off.
  double world_age_s = 0;
  double dt_s = 0.01;
  /// Something limited the last motion, or had limited it before the robot was stopped there: the
  /// next motion may slide along it.
  bool touching = false;
  /// Radius of the disc about the robot's origin that contains its body; above 0.
  double radius_m = 0;
  const world::Body* body = nullptr;
  std::span<const GuardNeighbour> neighbours;  ///< The robots within guard_reach_m().
};

struct GuardOutput {
  Command command;
  std::uint32_t lost_sensor = 0;  ///< For kSensorLost: index of the first sensor that is too old.
  std::uint32_t acted = 0;  ///< Bit `1 << limit` is set for each limit that changed the command.

  [[nodiscard]] bool by(GuardLimit limit) const noexcept {
    return (acted >> static_cast<std::uint32_t>(limit) & 1U) != 0;
  }
};

/// The distance from the disc of a robot's outline beyond which other robots cannot affect the
/// separation limit in this step. Finite even for infinite commands and speeds.
[[nodiscard]] double guard_reach_m(const GuardSpec& spec, const GuardInput& input) noexcept;

/// Limits one command. Pure: the same input gives the same bits; any thread; no allocation.
/// Formulas and assumptions: docs/explanation/guard.md.
///
/// Motions are limited, whatever commands lead to them: see ActuatorDrive. `kJoint` and `kValues`
/// pass unchanged if they are finite and no limit stops the robot; otherwise the actuator gets no
/// command. `kGoal` is never passed on, because the actuator itself would choose the path.
[[nodiscard]] GuardOutput guard(const GuardSpec& spec, const GuardInput& input) noexcept;

}  // namespace rave::sim
