// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/describe_run.hpp"

#include "rave/observe/kinds.hpp"
#include "rave/recording/part_keeper.hpp"
#include "rave/recording/record_keeper.hpp"

namespace rave::runtime {

DescribedRun describe_run(const BuiltScenario& built) {
  const sim::EngineSpec& spec = built.spec;
  DescribedRun run{info_of(spec, BodyKinds(spec, built.robot_kinds)),
                   PartKeeper::describe(spec, true)};
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    // Only what the files say: no driver is open here, so limits and bearings of the sensors are
    // unknown.
    const auto& sensors = spec.types[spec.robots[r].type].sensors;
    for (std::uint32_t s = 0; s < sensors.size(); ++s) {
      record::RecordedSensor sensor;
      sensor.robot = RobotId(r);
      sensor.sensor = DeviceId(s);
      sensor.name = sensors[s].name;
      sensor.kind = static_cast<std::uint32_t>(sensors[s].kind);
      sensor.X_RS = sensors[s].X_RS;
      sensor.z_m = sensors[s].z_m;
      sensor.period_s = sensors[s].period_steps * spec.step.seconds();
      sensor.is_virtual = sensors[s].virtual_ops != nullptr;
      run.info.sensors.push_back(std::move(sensor));
    }
  }
  return run;
}

}  // namespace rave::runtime
