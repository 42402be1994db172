// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Used instead of a sensor index to request the velocity commands of a robot. No robot has as many
/// sensors.
inline constexpr std::uint32_t kCommandsOf = 0xefff;
inline constexpr std::uint32_t kCommandFields = 4;

/// The velocity commanded by the program or by the user who drives the robot: forward (m/s) and
/// counter-clockwise (rad/s); then the velocity passed to the actuator, after controllers and
/// guard. NaN: no velocity. Empty for a robot of another host, or without a velocity controller and
/// actuator.
[[nodiscard]] std::optional<std::array<float, kCommandFields>> command_row(
    const sim::Engine& engine, RobotId robot);

}  // namespace rave::onlook
