// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/sim/guard.hpp"
#include "robot_group.hpp"

/// How the guard knows that a sensor of a real robot is dead.
///
/// A sensor whose samples come periodically, or whose file has `max_age_s`, is lost when its newest
/// sample is older than that. A sensor of events is lost while its driver says so. Any other says
/// nothing that could be judged: it is not watched.
namespace rave::sim {

/// In SensorSlots::heard_ns.
inline constexpr std::int64_t kNeverHeard_ns = INT64_MIN;

/// The largest age of a sensor's samples; not set: it is not watched. `staleness` is that of the
/// robot whose pose the sensor gives, not set for any other sensor. A live one may be as silent as
/// its poses may be old: stamps alone do not suffice, since they may lie ahead. Error kPlugin: a
/// periodic driver that did not declare its period.
[[nodiscard]] Result<std::optional<double>> max_age_s(const SensorSpec& sensor,
                                                      const HardwareDeclaration& declaration,
                                                      std::optional<Duration> staleness);

/// The limit that a program gets (SensorInfo::max_age_s): half as much again, so that the guard has
/// stopped the robot, and said why, when its program sees that the sample is old. The latency of
/// the file comes on top.
[[nodiscard]] double told_max_age_s(const SensorSlots& slots) noexcept;

/// Time since the newest raw sample of a sensor was true, by its stamp; in a live run the time
/// since it arrived is that of the wall clock. Of a sensor of events 0, or infinity while it is
/// lost. Infinite before the first sample. In a live run any thread, without the engine's lock; in
/// a stepped one that of the engine.
[[nodiscard]] double sensor_age_s(const SensorSlots& slots, std::size_t member, SimTime now);

/// Whether a sensor counts as lost when its driver says so, and not by its age.
[[nodiscard]] bool is_judged_by_link(const SensorSpec& sensor) noexcept;
/// sensor_age_s() of a sensor of a live run. Any thread.
[[nodiscard]] double live_age_s(const SampleQueue& queue, bool judged_by_link);

/// Fills `sensors` with those of one robot that are watched. Allocates only the first time.
void find_watched_sensors(const RobotGroup& group, std::size_t member, SimTime now,
                          std::vector<GuardSensor>& sensors);

/// The text of the event that a robot stands because of a sensor.
[[nodiscard]] std::string sensor_lost_text(const SensorSlots& slots, std::size_t member);
/// The same of a sensor that repeats itself, which may be the pose source.
[[nodiscard]] std::string sensor_frozen_text(const RobotGroup& group, std::uint32_t sensor);

}  // namespace rave::sim
