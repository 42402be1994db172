// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::lock_step {

/// Fills a wire member with an input, except for its changes; it borrows from `points`. Errors:
/// kInvalidArgument: more than the bus can carry.
[[nodiscard]] Status to_wire(const sim::WorldInput& input, rave_wire_WorldInput& wire,
                             std::vector<rave_wire_OrderPoint>& points);
/// Borrows from the change. Errors: as above.
[[nodiscard]] Status to_wire(const sim::ParameterChange& change, rave_wire_ParameterChange& wire);

/// Errors: kInvalidArgument: an unknown kind of input or part of a robot.
[[nodiscard]] Result<sim::WorldInput> from_wire(const rave_wire_WorldInput& wire);

}  // namespace rave::lock_step
