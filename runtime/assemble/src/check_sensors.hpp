// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Checks that the sensors of the scenario's checks give the right readings: otherwise a check
/// could hold because there is nothing to evaluate. `spec`: with the drivers of all robots. Errors:
/// kInvalidArgument, at the line of the check.
[[nodiscard]] Status check_sensors_of_checks(const config::ExpandedScenario& scenario,
                                             const sim::EngineSpec& spec);

}  // namespace rave::runtime
