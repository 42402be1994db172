// SPDX-License-Identifier: Apache-2.0
#include "check_sensors.hpp"

#include <algorithm>

namespace rave::runtime {
namespace {

const sim::SensorSpec* find_sensor(const sim::RobotType& type, const std::string& name) {
  const auto found = std::ranges::find(type.sensors, name, &sim::SensorSpec::name);
  return found == type.sensors.end() ? nullptr : &*found;
}

/// Checks that the sensor of a touches check gives contacts.
/// The reader of the scenario has checked that robots and sensors of checks exist. What a sensor
/// gives is known only now, after its driver has been loaded.
Status check_touches(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec,
                     const config::TouchesCheckFile& check) {
  if (!check.sensor) return {};
  for (const auto& name : check.robots) {
    for (const std::size_t r : config::robots_named(scenario, *name)) {
      const sim::RobotType& type = spec.types[spec.robots[r].type];
      const sim::SensorSpec* const sensor = find_sensor(type, **check.sensor);
      // The expansion has refused robots without this sensor already.
      if (sensor == nullptr || sensor->kind == ReadingKind::kContact) continue;
      return fail_at(check.sensor->where, ErrorCode::kInvalidArgument,
                     "`touches`: sensor `{}` of robot `{}` gives {}; expected one that gives {}",
                     sensor->name, spec.robots[r].name, to_string(sensor->kind),
                     to_string(ReadingKind::kContact));
    }
  }
  return {};
}

/// Requires a real and a virtual camera: a virtual one would only confirm itself.
Status check_sightings(const config::SightingsCheckFile& check, const sim::EngineSpec& spec) {
  const auto gives_sightings = [](const sim::SensorSpec* sensor) {
    return sensor != nullptr && sensor->kind == ReadingKind::kSightings;
  };
  bool real = false;
  bool both = false;
  for (const sim::RobotType& type : spec.types) {
    const sim::SensorSpec* const camera = find_sensor(type, *check.real);
    const sim::SensorSpec* const twin = find_sensor(type, *check.twin);
    const bool is_real = gives_sightings(camera) && camera->hardware_ops != nullptr;
    real = real || is_real;
    both = both || (is_real && gives_sightings(twin) && twin->virtual_ops != nullptr);
  }
  if (both) return {};
  const auto& wrong = real ? check.twin : check.real;
  return fail_at(wrong.where, ErrorCode::kInvalidArgument,
                 "`sightings`: expected a robot with both sensors whose `{}` is a {} camera that "
                 "gives {}",
                 *wrong, real ? "virtual" : "real", to_string(ReadingKind::kSightings));
}

}  // namespace

Status check_sensors_of_checks(const config::ExpandedScenario& scenario,
                               const sim::EngineSpec& spec) {
  const config::ChecksFile& checks = scenario.scenario.checks;
  for (const config::TouchesCheckFile& check : checks.touches) {
    RAVE_TRY(check_touches(scenario, spec, check));
  }
  return checks.sightings ? check_sightings(*checks.sightings, spec) : Status{};
}

}  // namespace rave::runtime
