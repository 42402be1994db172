// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::runtime {

/// The change that a kAdd, kMove or kRemove requests. Errors: kParse, kInvalidArgument.
[[nodiscard]] Result<sim::ObstacleChange> asked_change(const RunRequest& request);

}  // namespace rave::runtime
