// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Calls `found(part, kind, header, records)` for the newest reading of a sensor and, with `parts`,
/// for those of its real and its virtual half. A header may be null. There is nothing of robots of
/// other hosts, whose engines have their readings, and of unknown ids.
template <class Found>
void for_each_part(const sim::Engine& engine, RobotId robot, std::uint32_t sensor, bool parts,
                   const Found& found) {
  const sim::EngineSpec& spec = engine.spec();
  if (robot.value() >= spec.robots.size() || !engine.is_local(robot)) return;
  const auto& sensors = spec.types[spec.robots[robot.value()].type].sensors;
  if (sensor >= sensors.size()) return;
  const ReadingKind kind = sensors[sensor].kind;
  const sim::SensorSample sample = engine.sensor(robot, sensor);
  found(std::uint8_t{0}, kind, sample.header, sample.records);
  if (!parts) return;
  const sim::SensorParts halves = engine.sensor_parts(robot, sensor);
  found(std::uint8_t{1}, kind, halves.real, halves.real_records);
  found(std::uint8_t{2}, kind, halves.imagined, halves.imagined_records);
}

}  // namespace rave::onlook
