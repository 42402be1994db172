// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "rave/request/request.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::runtime {

/// A stop, a release, an arming or an order as an input of a run, of a person or of the scenario;
/// empty: the action is none of these.
[[nodiscard]] std::optional<sim::WorldInput::Action> input_action(const request::Action& action);

}  // namespace rave::runtime
