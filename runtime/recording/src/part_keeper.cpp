// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/part_keeper.hpp"

#include <algorithm>

namespace rave::runtime {
namespace {

/// Calls `take(robot, sensor index, spec)` for each hybrid sensor of each robot.
template <class Take>
void each_hybrid(const sim::EngineSpec& spec, Take take, bool all = false) {
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const bool here =
        all || !spec.local ||
        std::find(spec.local->begin(), spec.local->end(), RobotId(r)) != spec.local->end();
    if (!here) continue;
    const auto& sensors = spec.types[spec.robots[r].type].sensors;
    for (std::uint32_t s = 0; s < sensors.size(); ++s) {
      if (sensors[s].hybrid) take(r, s, sensors[s]);
    }
  }
}

}  // namespace

void PartKeeper::follow(const sim::EngineSpec& spec) {
  // What was seen of a sensor is remembered, so that after a hand-over and back no sample is
  // recorded twice.
  each_hybrid(spec, [this](std::uint32_t robot, std::uint32_t s, const sim::SensorSpec& sensor) {
    hybrids_[{RobotId(robot), s}].kind = sensor.kind;
  });
}

record::StringMap PartKeeper::describe(const sim::EngineSpec& spec, bool all) {
  record::StringMap about;
  each_hybrid(
      spec,
      [&](std::uint32_t robot, std::uint32_t, const sim::SensorSpec& sensor) {
        about[spec.robots[robot].name + "/" + sensor.name] =
            fmt::format("{} of {} (real) and {} (virtual)", sensor.driver,
                        sensor.hybrid->real_driver, sensor.hybrid->virtual_driver);
      },
      all);
  return about;
}

void PartKeeper::keep(const sim::Engine& engine, record::RunRecorder& recorder) {
  for (auto& [place, hybrid] : hybrids_) {
    const RobotId robot = place.first;
    const DeviceId sensor(place.second);
    const ReadingKind kind = hybrid.kind;
    const sim::SensorParts parts = engine.sensor_parts(robot, place.second);
    if (parts.imagined == nullptr) continue;  // The sensor has other drivers at present.
    // Both parts are produced together, so the later one shows that both exist. Drivers that were
    // opened for a hand-over have produced none yet.
    if (parts.imagined->sequence <= hybrid.seen) continue;
    hybrid.seen = parts.imagined->sequence;
    const auto put = [&](record::PerceptPart part, const SampleHeader& header,
                         const void* records) {
      const std::size_t bytes = std::size_t{header.count} * record_size(kind);
      recorder.percept({robot,
                        sensor,
                        static_cast<std::uint8_t>(kind),
                        part,
                        {header.stamp_ns, header.sequence, header.count, 1, header.dropped},
                        {static_cast<const std::byte*>(records), bytes}});
    };
    put(record::PerceptPart::kReal, *parts.real, parts.real_records);
    put(record::PerceptPart::kVirtual, *parts.imagined, parts.imagined_records);
  }
}

}  // namespace rave::runtime
