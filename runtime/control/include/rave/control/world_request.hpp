// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"
#include "rave/sim/world_step.hpp"

// Requests to a run with several hosts: from users to the world authority, and from the world to
// the recordings of the hosts.
namespace rave::runtime {

/// The change of a parameter that is asked of a robot. Errors: kInvalidArgument and kNotFound,
/// without a place.
[[nodiscard]] Result<sim::ParameterChange> requested_parameter(const sim::EngineSpec& spec,
                                                               RobotId robot,
                                                               const request::Set& set);

/// A request as an input of the world, by hand. Errors: kNotFound and kInvalidArgument as in one
/// process; kState: a parameter of a program or driver, which only the host of the robot knows.
/// A list is not an input.
[[nodiscard]] Result<sim::WorldInput> input_of(const sim::EngineSpec& spec,
                                               const request::Request& request);

/// The inputs by hand that take effect in this step, in the form of requests to a single process.
[[nodiscard]] std::vector<request::Request> requests_in(const sim::EngineSpec& spec,
                                                        const sim::WorldStep& world);

/// The word for a change of an obstacle: `added`, `moved` or `removed`.
[[nodiscard]] std::string_view word_of(sim::ObstacleChange::Kind kind) noexcept;

}  // namespace rave::runtime
