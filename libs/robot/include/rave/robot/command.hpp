// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave {

/// The kind of commands that a controller or an actuator accepts.
enum class CommandKind : std::uint32_t {
  kNone = 0,
  kVelocity = 1,  ///< value = {v m/s, w rad/s}: body velocity forward and counter-clockwise.
  /// value = {x m, y m, largest speed m/s (0: default of the controller)}, world frame.
  kGoal = 2,
  kJoint = 3,   ///< value = {position rad, speed rad/s}: pan, tilt, steering.
  kValues = 4,  ///< The driver defines the meaning.
};

/// The name of a kind, as messages and `rave describe` print it.
[[nodiscard]] std::string_view to_string(CommandKind kind) noexcept;

/// One command. Plain data without padding: its bytes are part of the run hash.
struct Command {
  CommandKind kind = CommandKind::kNone;
  std::uint32_t count = 0;  ///< Number of values used.
  double value[4] = {};

  friend constexpr bool operator==(const Command&, const Command&) noexcept = default;
};
static_assert(sizeof(Command) == 40);

/// A body velocity: forward in m/s, turning counter-clockwise in rad/s.
[[nodiscard]] constexpr Command velocity_command(double v_mps, double w_radps) noexcept {
  return {CommandKind::kVelocity, 2, {v_mps, w_radps, 0, 0}};
}

/// A goal in the world frame; `speed_mps` 0: the default of the controller.
[[nodiscard]] constexpr Command goal_command(double x_m, double y_m,
                                             double speed_mps = 0) noexcept {
  return {CommandKind::kGoal, 3, {x_m, y_m, speed_mps, 0}};
}

/// A controller of a robot, for its program.
struct ControllerInfo {
  const char* name = "";
  CommandKind accepts = CommandKind::kNone;
  std::uint32_t reserved = 0;
};

}  // namespace rave
