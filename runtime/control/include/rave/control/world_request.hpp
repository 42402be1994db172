// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"
#include "rave/sim/world_step.hpp"

// Requests to a run whose robots run on several hosts: from people to the authority of the world,
// and from the world to the records of the hosts.
namespace rave::runtime {

/// What is asked, as an input of the world, by hand. Errors: kNotFound and kInvalidArgument as in
/// one process; kState: a parameter of a program or a driver, which only the host of the robot
/// knows. A kList is none.
[[nodiscard]] Result<sim::WorldInput> input_of(const sim::EngineSpec& spec,
                                               const RunRequest& request);

/// What was asked by hand and counts from this step on, as it would be asked of one process.
[[nodiscard]] std::vector<RunRequest> requests_in(const sim::EngineSpec& spec,
                                                  const sim::WorldStep& world);

/// What an obstacle that came, moved or went is told as: `added`, `moved` or `removed`.
[[nodiscard]] std::string_view word_of(sim::ObstacleChange::Kind kind) noexcept;

/// Number, name, layer and place of all obstacles that stand, a line each.
[[nodiscard]] std::string obstacle_list(const world::WorldModel& world);

}  // namespace rave::runtime
