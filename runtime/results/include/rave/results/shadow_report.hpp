// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "rave/results/facts.hpp"

namespace rave::runtime {

/// `shadows` of result.json. Reports that are not JSON objects are omitted, because they may come
/// from other hosts.
[[nodiscard]] nlohmann::ordered_json shadows_json(const std::vector<ShadowFacts>& shadows);

}  // namespace rave::runtime
