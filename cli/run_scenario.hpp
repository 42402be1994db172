// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/run.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::cli {

/// Reads the scenario of a command line, with what that overrides put in. Errors: those of
/// find_scenario() and config::expand_scenario(), kInvalidArgument.
[[nodiscard]] Result<config::ExpandedScenario> read_scenario(const RunCommand& options);

}  // namespace rave::cli
