// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/error.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::runtime {

/// What is allowed but hardly meant, each with its place and what is usual: a target inside an
/// obstacle, a change after the end, a right for a team without robots, a range sensor above
/// everything, a huge body, a robot that no program drives. `built` is the scenario, built.
[[nodiscard]] std::vector<Error> warnings_of(const config::ExpandedScenario& scenario,
                                             const BuiltScenario& built);

}  // namespace rave::runtime
