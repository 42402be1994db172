// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// In the place of a sensor's index: the velocities that a robot is told. No robot has as many
/// sensors.
inline constexpr std::uint32_t kCommandsOf = 0xefff;
inline constexpr std::uint32_t kCommandFields = 4;

/// What was asked of a robot, by its program or by whoever drives it: forward, m/s, and to the
/// left, rad/s; then what its actuator was told, behind controllers and guard. NaN: no velocity.
/// Nothing for a robot of another host or without a controller and actuator of velocities.
[[nodiscard]] std::optional<std::array<float, kCommandFields>> command_row(
    const sim::Engine& engine, RobotId robot);

}  // namespace rave::onlook
