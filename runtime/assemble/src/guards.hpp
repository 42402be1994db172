// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// The `guard:` section of a robot file; empty if there is none. Errors: a fence that crosses
/// itself.
[[nodiscard]] Result<std::optional<sim::GuardSpec>> guard_spec(const config::RobotGroup& group);

/// Adds the parameter changes of `changes:` to the spec of an engine. Errors give the place of the
/// value.
Status add_changes(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

}  // namespace rave::runtime
