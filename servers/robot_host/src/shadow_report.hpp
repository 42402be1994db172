// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "facts.hpp"

namespace rave::robot_host {

/// `shadows` of result.json. What is no JSON object, as it may come from elsewhere, is left out.
[[nodiscard]] nlohmann::ordered_json shadows_json(const std::vector<ShadowFacts>& shadows);

}  // namespace rave::robot_host
