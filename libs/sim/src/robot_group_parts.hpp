// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rave/base/crash_note.hpp"
#include "robot_group.hpp"

/// What robot_group.cpp and robot_sensors.cpp share.
namespace rave::sim {

/// What a crash says of the driver or program of one robot; see CrashScope.
[[nodiscard]] CrashNote crash_note_of(const GroupContext& context, RobotId id, const char* part,
                                      const std::string& driver);
/// An error with robot, part and driver, and with the place of the driver in the robot file.
[[nodiscard]] Error named_error(const GroupContext& context, RobotId id, std::string_view kind,
                                std::string_view name, std::string_view driver,
                                const SourceLocation& where, Error error);
/// The object of the device that a sensor or actuator names; null if it names none.
[[nodiscard]] HardwareDevice* device_of(const RobotGroup& group, std::optional<std::uint32_t> index,
                                        std::size_t member);

/// Errors: what the driver says.
Status make_sensor(const GroupContext& context, RobotGroup& group, SensorSlots& slots);
/// Sensors as new, their queues open.
void clear_sensors(RobotGroup& group);

}  // namespace rave::sim
