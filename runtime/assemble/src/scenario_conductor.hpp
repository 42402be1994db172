// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Gives the spec a conductor if its scenario has a script, or entries of `changes:` that are not
/// simply due at a time. Everything is checked now: names, expressions, values. Errors with the
/// place in the scenario or the script.
Status add_conductor(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

}  // namespace rave::runtime
