// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/bus/command_box.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// A handler of the topic rave/command that lets users drive the robots of a process. It treats
/// each command like a request at the control socket, so lease and rate are checked there. Other
/// kinds of commands are ignored. `scenario`: scenario of the run. `control` must outlive the
/// handler, which does not block.
[[nodiscard]] bus::OnCommand commands_of(runtime::RunControl& control,
                                         const config::ExpandedScenario& scenario);

/// A drive request as a command for the bus, without run and writer, which its Writer sets.
/// bus::validate() refuses non-finite numbers and names that are too long.
[[nodiscard]] bus::Command drive_command(const runtime::RunRequest& drive, std::uint32_t robot,
                                         std::uint64_t number);

}  // namespace rave::control
