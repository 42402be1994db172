// SPDX-License-Identifier: Apache-2.0
#include "rave/real_time/realities.hpp"

#include <fmt/format.h>

namespace rave::real_time {

Result<Realities> Realities::create(bus::Bus& bus, std::uint32_t own_host,
                                    std::vector<std::uint32_t> host_of) {
  RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::RosterEntry>::create(bus));
  return Realities(own_host, std::move(host_of), std::move(reader));
}

void Realities::hear() {
  reader_.take([this](const bus::RosterEntry& entry) {
    if (entry.host == own_host_) return;
    const bool fits = entry.robot < host_of_.size() && host_of_[entry.robot] == entry.host &&
                      entry.kind != rave_wire_ROBOT_SHADOW;
    if (fits) {
      heard_[RobotId(entry.robot)] = entry.kind == rave_wire_ROBOT_SIMULATED;
    } else if (!std::exchange(refused_, true)) {
      reader_.refuse(entry, fmt::format("robot {} does not run on host {}, or not so", entry.robot,
                                        entry.host));
    }
  });
}

std::vector<RobotReality> Realities::take() {
  std::vector<RobotReality> realities;
  for (const auto& [robot, simulated] : heard_) realities.push_back({robot, simulated});
  heard_.clear();
  return realities;
}

}  // namespace rave::real_time
