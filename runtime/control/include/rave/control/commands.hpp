// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/command_box.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"

/// Orders as commands on the bus (topic rave/command).
namespace rave::control {

/// Lets users order the robots of a process: each command is treated like a request at the control
/// socket, so lease and rate are checked there. Commands to robots of other hosts are ignored,
/// because their hosts answer. `host`: the one of this process; empty: it runs all robots of the
/// scenario. `control` must outlive the result. Errors: those of config::plan_hosts().
[[nodiscard]] Result<bus::BeginCommand> commands_of(runtime::RunControl& control,
                                                    const config::ExpandedScenario& scenario,
                                                    std::string_view host);

/// Converts an order, a stop, a release or an arming. Run and writer are set by its Writer; robot
/// and number by the caller. The command refers to `points`, which must outlive it. Errors:
/// kInvalidArgument (another kind, no author, too many points, or a text that is too long).
[[nodiscard]] Status to_command(const request::Request& request, bus::Command& command,
                                std::vector<rave_wire_OrderPoint>& points);

/// The inverse of to_command(), for a command that bus::validate() accepts. Errors:
/// kInvalidArgument (number of points, or an author that is reserved).
[[nodiscard]] Result<request::Request> request_of(const bus::Command& command, std::string robot);

}  // namespace rave::control
