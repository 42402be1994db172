// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/diagnostics.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {

/// What can only be checked once a scenario and its files are together.
void check_expansion(const ExpandedScenario& expanded, Diagnostics& diagnostics);

}  // namespace rave::config
