// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "commands/run.hpp"
#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::cli {

/// What `rave run` would do, for people: the processes with their robots, who may do what on the
/// page, and what happens when. `hosts` are those of config::plan_hosts().
[[nodiscard]] std::string run_plan(const RunCommand& options,
                                   const config::ExpandedScenario& scenario,
                                   const std::vector<config::PlannedHost>& hosts,
                                   const runtime::BuiltScenario& built);

/// What happens when, in the order of the plan, as the array `due` of the message `conduct`.
[[nodiscard]] std::string due_json(const config::ExpandedScenario& scenario);

}  // namespace rave::cli
