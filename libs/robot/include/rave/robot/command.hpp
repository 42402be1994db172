// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave {

/// The kind of commands that a controller or an actuator accepts.
enum class CommandKind : std::uint32_t {
  kNone = 0,
  /// value = {v m/s, w rad/s, vy m/s}: body velocity forward, counter-clockwise and to the left.
  /// Only drives that move sideways look at vy.
  kVelocity = 1,
  /// value = {x m, y m, largest speed m/s (0: default of the controller)}, world frame.
  kGoal = 2,
  kJoint = 3,   ///< value = {position rad, speed rad/s}: pan, tilt, steering.
  kValues = 4,  ///< The driver defines the meaning.
  /// value = {steering, throttle, brake, gear}: see pedals_command().
  kPedals = 5,
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

/// The same with a velocity to the left, m/s. Equal bits as without, if that is 0.
[[nodiscard]] constexpr Command velocity_command(double v_mps, double w_radps,
                                                 double vy_mps) noexcept {
  if (vy_mps == 0) return velocity_command(v_mps, w_radps);
  return {CommandKind::kVelocity, 3, {v_mps, w_radps, vy_mps, 0}};
}

/// What a person does with a car. `steering`: share of the largest angle, from -1 (right) to 1
/// (left). `throttle` and `brake`: shares from 0 to 1. `gear`: 1 forward, 0 neutral, -1 reverse.
[[nodiscard]] constexpr Command pedals_command(double steering, double throttle, double brake,
                                               double gear) noexcept {
  return {CommandKind::kPedals, 4, {steering, throttle, brake, gear}};
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
