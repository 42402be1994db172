// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/bus/command_box.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// Lets people drive robots of a process over the topic rave/command, as if each command had been
/// said at its control socket: lease and rate are checked there. Of other kinds of commands nothing
/// is taken. `scenario`: that of the run. `control` outlives what is returned, which waits for
/// nothing.
[[nodiscard]] bus::OnCommand commands_of(runtime::RunControl& control,
                                         const config::ExpandedScenario& scenario);

/// A drive as a command for the bus; run and writer are filled in by its writer. Not finite, or
/// with a name that is too long: see bus::validate().
[[nodiscard]] bus::Command drive_command(const runtime::RunRequest& drive, std::uint32_t robot,
                                         std::uint64_t number);

}  // namespace rave::control
