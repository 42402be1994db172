// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// What a kAdd, kMove or kRemove asks for. Errors: kParse, kInvalidArgument.
[[nodiscard]] Result<sim::ObstacleChange> asked_change(const RunRequest& request);

}  // namespace rave::runtime
