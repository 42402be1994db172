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
/// Runs `start`, which calls the plug-in of a part. Its error, or a crash in it, names the robot
/// and the part.
template <class Start>
Status start_part(const GroupContext& context, RobotId id, const NamedPart& part, Start start) {
  const CrashNote whose = crash_note_of(context, id, part.kind, part.driver);
  const CrashScope scope(whose);
  return of_part(context.spec.robots[id.value()], part, start());
}

/// The object of the device that a sensor or actuator names; null if it names none.
[[nodiscard]] HardwareDevice* device_of(const RobotGroup& group, std::optional<std::uint32_t> index,
                                        std::size_t member);

/// Errors: what the driver says.
Status make_sensor(const GroupContext& context, RobotGroup& group, SensorSlots& slots);
/// Sensors as new, their queues open.
void clear_sensors(RobotGroup& group);

}  // namespace rave::sim
