// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/bus/run_id.hpp"
#include "rave/launch/run_settings.hpp"

namespace rave::launch {

/// The command line that starts a host of a run, for people and their shells: with all that its
/// processes must agree on. On another machine --interface and --peer may have to be others.
[[nodiscard]] std::string host_command(const RunSettings& settings, const std::string& host,
                                       const bus::RunId& run);

}  // namespace rave::launch
