// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// The state of a shadow as `rave ps --json` and the page have it.
[[nodiscard]] nlohmann::ordered_json shadow_json(const RunStatus::Shadow& shadow);

}  // namespace rave::runtime
