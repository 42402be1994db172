// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "rave/robot_host/lateness.hpp"

namespace rave::robot_host {

/// How a run kept its deadlines, for result.json; null of one without a pace.
[[nodiscard]] nlohmann::ordered_json lateness_json(const LatenessFacts& facts);

}  // namespace rave::robot_host
