// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "commands/run.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::cli {

/// The command line that starts a host of a run, for people and their shells: with all that its
/// processes must agree on. On another machine --interface and --peer may have to be others.
[[nodiscard]] std::string host_command(const RunCommand& options, const std::string& host,
                                       const bus::RunId& run);

}  // namespace rave::cli
