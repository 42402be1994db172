// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// The robot of this name in this process. Error: kNotFound.
[[nodiscard]] Result<RobotId> find_robot_here(const sim::Engine& engine, std::string_view name);

/// Executes a request between two steps. Returns a description of what was done.
[[nodiscard]] Result<std::string> serve_request(sim::Engine& engine,
                                                const request::Request& request);

/// Checks that an order could be carried out now; errors are those of the request.
[[nodiscard]] Status check_order_now(const sim::Engine& engine, const sim::WorldInput& input);

/// Updates the robots of a status and whether they may move.
void refresh_status(const sim::Engine& engine, RunStatus& status);

/// Names of the real robots that wait to be armed, as `a, b and c`; empty: none.
[[nodiscard]] std::string unarmed_robots(const sim::Engine& engine);

}  // namespace rave::runtime
