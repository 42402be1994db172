// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "rave/pace/lateness.hpp"

namespace rave::runtime {

/// The missed deadlines of a run for result.json; null for a run without a pace.
[[nodiscard]] nlohmann::ordered_json lateness_json(const LatenessFacts& facts);

}  // namespace rave::runtime
