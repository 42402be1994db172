// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave {

/// What a controller takes from a program, or an actuator from a controller.
enum class CommandKind : std::uint32_t {
  kNone = 0,
  kVelocity = 1,  ///< value = {v m/s, w rad/s}: body velocity forward and counter-clockwise.
  kGoal = 2,      ///< value = {x m, y m, largest speed m/s (0: the controller's own)}, world frame.
  kJoint = 3,     ///< value = {position rad, speed rad/s}: pan, tilt, steering.
  kValues = 4,    ///< Meaning said by the driver.
};

/// The name of a kind, as messages and `rave describe` print it.
[[nodiscard]] std::string_view to_string(CommandKind kind) noexcept;

/// One command. Plain data without padding: its bits are part of the run hash.
struct Command {
  CommandKind kind = CommandKind::kNone;
  std::uint32_t count = 0;  ///< Values in use.
  double value[4] = {};

  friend constexpr bool operator==(const Command&, const Command&) noexcept = default;
};
static_assert(sizeof(Command) == 40);

/// A body velocity: forward in m/s, turning counter-clockwise in rad/s.
[[nodiscard]] constexpr Command velocity_command(double v_mps, double w_radps) noexcept {
  return {CommandKind::kVelocity, 2, {v_mps, w_radps, 0, 0}};
}

/// A goal in the world frame; `speed_mps` 0: as fast as the controller likes.
[[nodiscard]] constexpr Command goal_command(double x_m, double y_m,
                                             double speed_mps = 0) noexcept {
  return {CommandKind::kGoal, 3, {x_m, y_m, speed_mps, 0}};
}

/// A controller of a robot as its program sees it.
struct ControllerInfo {
  const char* name = "";
  CommandKind accepts = CommandKind::kNone;
  std::uint32_t reserved = 0;
};

}  // namespace rave
