// SPDX-License-Identifier: Apache-2.0
#include "rave/manager/manager.hpp"

#include "stepped_run.hpp"

namespace rave::manager {

std::vector<HostSlot> make_slots(const std::vector<config::PlannedHost>& hosts) {
  std::vector<HostSlot> slots;
  for (const config::PlannedHost& host : hosts) {
    HostSlot slot;
    slot.name = host.name;
    slot.robots = static_cast<std::uint32_t>(host.robots.size());
    slots.push_back(std::move(slot));
  }
  return slots;
}

Result<ManagerOutcome> manage(sim::EngineSpec spec, const ManagerOptions& options) {
  std::vector<std::uint32_t> host_of(spec.robots.size());
  for (std::uint32_t h = 0; h < options.hosts.size(); ++h) {
    for (const std::size_t robot : options.hosts[h].robots) host_of[robot] = h;
  }
  RAVE_TRY(check_scheduled(spec));
  RAVE_TRY_ASSIGN(auto authority, sim::WorldAuthority::create(std::move(spec), std::move(host_of)));
  RAVE_TRY_ASSIGN(auto bus, SteppedEndpoint::open(options));
  SteppedRun run(options, std::move(authority), std::move(bus));
  auto outcome = run.go();
  // Hosts wait for the next world. An error here must reach them, or they would wait for a manager
  // that is gone.
  if (!outcome) run.give_up(outcome.error());
  return outcome;
}

}  // namespace rave::manager
