// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Sets the start pose of every simulated robot: from the file, or a random free place in its
/// rectangle. Errors: a robot without a pose, one that starts inside something, a rectangle without
/// room.
Status put_down_robots(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

}  // namespace rave::runtime
