// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Does what somebody asks of a run, between two steps. Returns what was done, for people.
[[nodiscard]] Result<std::string> serve_request(sim::Engine& engine, const RunRequest& request);

/// Which robots there are and whether they may move.
void refresh_status(const sim::Engine& engine, RunStatus& status);

/// Real robots that stand until somebody arms them, as `a, b and c`; empty: none.
[[nodiscard]] std::string unarmed_robots(const sim::Engine& engine);

}  // namespace rave::runtime
