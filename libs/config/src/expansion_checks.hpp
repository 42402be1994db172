// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/described.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {

/// Checks that concern a scenario together with its files.
void check_expansion(const ExpandedScenario& expanded, Diagnostics& diagnostics);

}  // namespace rave::config
