// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "commands/run.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::cli {

/// `rave run` of a scenario with hosts: this process is the environment manager, and starts a
/// `rave robot` for each host that is not elsewhere. Their folders lie in `hosts` of the run's own.
/// Under the policy `restart`, a host that dies is started again. Returns the exit code.
[[nodiscard]] Result<int> run_shared(const RunCommand& options, config::ExpandedScenario& scenario,
                                     const std::vector<config::PlannedHost>& hosts);

}  // namespace rave::cli
