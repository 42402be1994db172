// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// Gives every simulated robot its start: the pose of the file, or a free place of its rectangle
/// drawn by the seed. Errors: a robot without a pose, one that starts inside something, a rectangle
/// that is too full.
Status put_down_robots(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

}  // namespace rave::runtime
