// SPDX-License-Identifier: Apache-2.0
#include "run_scenario.hpp"

#include <fmt/format.h>

#include <utility>

#include "places.hpp"
#include "rave/config/any_file.hpp"

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
  const bool lone = !scenario.processes && scenario.hosts.empty();
  if (options.on_bus && lone) scenario.processes = 1;
  if (!options.duration_s) return {};
  scenario.duration_s = *options.duration_s;
  // An instant that a shorter run never reaches: the middle instead.
  if (scenario.picture && scenario.picture->instant_s.value_or(0) > *options.duration_s) {
    scenario.picture->instant_s.reset();
  }
  return {};
}

/// Of a robot or a world the missing keys of a scenario would say nothing.
Error why_no_scenario(const std::filesystem::path& path, Error error) {
  const auto kind = config::recognise(path);
  if (!kind || *kind == config::FileKind::kScenario) return error;
  return {ErrorCode::kInvalidArgument,
          fmt::format("`{0}` is a {1} file; expected a scenario, which names it (`rave check {0}` "
                      "checks it alone)",
                      path.string(), to_string(*kind)),
          {}};
}

}  // namespace

Result<config::ExpandedScenario> read_scenario(const RunCommand& options) {
  RAVE_TRY_ASSIGN(const auto path, find_scenario(options.scenario));
  auto expanded = config::expand_scenario(path, options.set);
  if (!expanded) return tl::unexpected(why_no_scenario(path, std::move(expanded).error()));
  config::ExpandedScenario scenario = *std::move(expanded);
  RAVE_TRY(override_settings(options, scenario.scenario));
  return scenario;
}

}  // namespace rave::cli
