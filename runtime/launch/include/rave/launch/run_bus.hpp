// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/bus_options.hpp"
#include "rave/bus/config.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::launch {

/// The bus of a process of a run, with room for all hosts. Errors: of the hosts of the scenario,
/// those of bus::bus_config().
[[nodiscard]] Result<bus::BusConfig> bus_of_run(const bus::BusOptions& options,
                                                const std::string& participant,
                                                const config::ExpandedScenario& scenario,
                                                bus::Reach reach);

/// The bus of the environment manager of a run whose hosts this process starts: unless `options`
/// name the run, it is one of its own, even if the same scenario runs elsewhere on the bus.
/// `lines`: the hosts have direct lines. Errors: those of bus::bus_config().
[[nodiscard]] Result<bus::BusConfig> bus_of_own_run(const bus::BusOptions& options,
                                                    const config::ExpandedScenario& scenario,
                                                    const std::vector<config::PlannedHost>& hosts,
                                                    bool lines);

}  // namespace rave::launch
