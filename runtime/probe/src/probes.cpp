// SPDX-License-Identifier: Apache-2.0
#include "rave/probe/probes.hpp"

#include <algorithm>

#include "rave/probe/probe_block.hpp"

namespace rave::probe {

void Probes::ask(const sim::Engine& engine, plugin::Catalogue& catalogue,
                 std::span<const Asked> asked) {
  if (std::ranges::equal(asked, asked_)) return;
  asked_.assign(asked.begin(), asked.end());
  std::erase_if(probes_, [asked](const auto& probe) {
    return std::ranges::none_of(asked, [&probe](const Asked& one) {
      return std::pair(one.robot, one.number) == probe.first;
    });
  });
  for (const Asked& one : asked) {
    const bool here = one.robot < engine.spec().robots.size() &&
                      engine.is_local(RobotId(one.robot)) && is_probe(one.number);
    if (!here || probes_.size() >= kMost) continue;
    const auto [probe, fresh] = probes_.try_emplace({one.robot, one.number});
    if (!fresh) continue;
    // The requester has created the sensor as well and reported its errors.
    auto spec = read_block(one.block, catalogue);
    if (!spec) continue;
    auto sensor = sim::LoneSensor::make(*std::move(spec), engine.spec().step.seconds());
    if (sensor) probe->second = *std::move(sensor);
  }
}

void Probes::sample(const sim::Engine& engine) {
  const world::Snapshot& world = engine.snapshot();
  for (const auto& [key, sensor] : probes_) {
    if (!sensor || (sensor->header().sequence != 0 && sensor->header().stamp_ns == world.time().ns))
      continue;
    // After a failure of the driver there are no new readings, and the viewer sees their age.
    static_cast<void>(sensor->sample(world, RobotId(key.first), engine.spec().seed));
  }
}

}  // namespace rave::probe
