// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "rave/pace/lateness.hpp"

namespace rave::runtime {

/// How a run kept its deadlines, for result.json; null of one without a pace.
[[nodiscard]] nlohmann::ordered_json lateness_json(const LatenessFacts& facts);

}  // namespace rave::runtime
