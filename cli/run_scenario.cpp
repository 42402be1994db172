// SPDX-License-Identifier: Apache-2.0
#include "run_scenario.hpp"

#include "places.hpp"

namespace rave::cli {
namespace {

Status override_settings(const RunCommand& options, config::ScenarioFile& scenario) {
  if (options.seed) scenario.seed = *options.seed;
  if (options.threads) scenario.threads = *options.threads;
  if (options.pace) {
    auto pace = config::parse_pace(*options.pace);
    if (!pace) return tl::unexpected(std::move(pace).error().with_context("--pace"));
    scenario.pace = *pace;
  }
  if (options.processes) {
    scenario.processes = *options.processes;
    scenario.hosts.clear();
    if (*options.processes == 1) scenario.processes.reset();
  }
  if (!options.duration_s) return {};
  scenario.duration_s = *options.duration_s;
  // An instant that a shorter run never reaches: the middle instead.
  if (scenario.picture && scenario.picture->instant_s.value_or(0) > scenario.duration_s) {
    scenario.picture->instant_s.reset();
  }
  return {};
}

}  // namespace

Result<config::ExpandedScenario> read_scenario(const RunCommand& options) {
  RAVE_TRY_ASSIGN(const auto path, find_scenario(options.scenario));
  RAVE_TRY_ASSIGN(auto scenario, config::expand_scenario(path));
  RAVE_TRY(override_settings(options, scenario.scenario));
  return scenario;
}

WantedFolder wanted_folder(const RunCommand& options) {
  return {options.output, options.replace, find_scenario(options.scenario).value_or("")};
}

}  // namespace rave::cli
