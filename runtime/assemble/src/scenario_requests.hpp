// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/request/request.hpp"
#include "rave/script/value.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::runtime {

/// The parts of a scenario that names of robots, teams and users stand in.
[[nodiscard]] config::ExpandedScenario names_in(const config::ExpandedScenario& scenario);

/// The robots that a name of the scenario stands for: one, or those of an entry. Error: kNotFound,
/// with the nearest name.
[[nodiscard]] Result<std::vector<RobotId>> meant_robots(const config::ExpandedScenario& scenario,
                                                        std::string_view name);

/// What a request of the scenario asks of the run, for each robot that it names. Errors: of the
/// robot, the key and the value of a parameter, the obstacle; a request that only people make.
[[nodiscard]] Result<std::vector<sim::WorldInput>> inputs_of(
    const config::ExpandedScenario& scenario, const sim::EngineSpec& spec,
    const request::Request& request);

/// The change of a scenario without its time, likewise. Of `robot` with `set`, an obstacle or
/// `request`; nothing of the others.
[[nodiscard]] Result<std::vector<sim::WorldInput>> inputs_of(
    const config::ExpandedScenario& scenario, const sim::EngineSpec& spec,
    const config::ChangeFile& change);

/// A request as a script writes it: `goal{robot = "r1", point = {1, 2}}`. Errors: those of
/// request::from_node().
[[nodiscard]] Result<request::Request> request_of(std::string_view action,
                                                  const script::Value& members);

/// The texts of events that give a team, and those below it, to a user (config::TeamGift).
[[nodiscard]] std::vector<std::string> gifts_of(const config::ExpandedScenario& scenario,
                                                std::string_view team, std::string_view to);
/// The same of a table `{team = NAME, to = NAME}` of a script. Error kNotFound: no team or
/// commander of the scenario.
[[nodiscard]] Result<std::vector<std::string>> gifts_of(const config::ExpandedScenario& scenario,
                                                        const script::Value& members);

}  // namespace rave::runtime
