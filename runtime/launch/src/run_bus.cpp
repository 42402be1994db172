// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/run_bus.hpp"

#include "rave/protocol/agreement.hpp"

namespace rave::launch {

Result<bus::BusConfig> bus_of_run(const bus::BusOptions& options, const std::string& participant,
                                  const config::ExpandedScenario& scenario, bus::Reach reach) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  RAVE_TRY_ASSIGN(auto bus,
                  bus::bus_config(options, participant, runtime::shared_number(scenario)));
  // Runs of many hosts need a higher limit of participants than the default.
  bus::make_room(bus, hosts.size(), reach);
  return bus;
}

Result<bus::BusConfig> bus_of_own_run(const bus::BusOptions& options,
                                      const config::ExpandedScenario& scenario,
                                      const std::vector<config::PlannedHost>& hosts, bool lines) {
  bus::BusOptions own = options;
  if (own.run.empty()) own.run = bus::RunId::random().text();
  RAVE_TRY_ASSIGN(auto bus,
                  bus::bus_config(own, "environment manager", runtime::shared_number(scenario)));
  // A line has an end of its own on the bus.
  bus::make_room(bus, lines ? 2 * hosts.size() : hosts.size(), bus::Reach::kHub);
  return bus;
}

}  // namespace rave::launch
