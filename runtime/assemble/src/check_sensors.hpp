// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Whether the sensors that the scenario's checks name give what the checks look at: otherwise a
/// check could hold because there is nothing to see. `spec`: with the drivers of all robots.
/// Errors: kInvalidArgument, at the line of the check.
[[nodiscard]] Status check_sensors_of_checks(const config::ExpandedScenario& scenario,
                                             const sim::EngineSpec& spec);

}  // namespace rave::runtime
