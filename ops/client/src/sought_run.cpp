// SPDX-License-Identifier: Apache-2.0
#include "rave/client/sought_run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "rave/bus/bus_options.hpp"
#include "rave/protocol/agreement.hpp"

namespace rave::client {

RunSeeker::RunSeeker(config::ExpandedScenario scenario) : scenario_(std::move(scenario)) {
  known_.emplace(runtime::shared_number(scenario_), 0);
}

std::optional<int> RunSeeker::processes_of(std::uint64_t number) {
  const bool divided =
      scenario_.scenario.processes.has_value() || !scenario_.scenario.hosts.empty();
  // The number of a large scenario takes a while, so no more are made than needed.
  while (!divided && !known_.contains(number) && tried_ < static_cast<int>(bus::kMostHosts)) {
    config::ExpandedScenario other = scenario_;
    other.scenario.processes = ++tried_;
    known_.emplace(runtime::shared_number(other), tried_);
  }
  const auto known = known_.find(number);
  return known == known_.end() ? std::nullopt : std::optional(known->second);
}

Result<std::optional<SoughtRun>> RunSeeker::seek(const bus::BusConfig& config, Duration patience,
                                                 const std::stop_token& stop) {
  const std::string& name = scenario_.scenario.name.value;
  const auto fits = [this](const watch::ScenarioRun& run) {
    return processes_of(run.number).has_value();
  };
  const auto wanted = [&](const watch::ScenarioRun& run) {
    return run.scenario == name || known_.contains(run.number);
  };
  RAVE_TRY_ASSIGN(const auto runs, watch::find_scenario_runs(config, patience, wanted, stop));
  std::vector<watch::ScenarioRun> named;
  std::ranges::copy_if(runs, std::back_inserter(named), wanted);
  if (named.empty()) return std::optional<SoughtRun>();
  const auto same = std::ranges::find_if(named, fits);
  const watch::ScenarioRun& run = same != named.end() ? *same : named.front();
  SoughtRun sought{run.run, scenario_, same == named.end()};
  const int processes = processes_of(run.number).value_or(0);
  if (processes > 0) sought.scenario.scenario.processes = processes;
  return std::optional(std::move(sought));
}

}  // namespace rave::client
