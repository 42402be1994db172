// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/replay/played_scenario.hpp"

namespace rave::replay {

/// The maps of a recorded run and their images as files of the played scenario, in `maps/`. The
/// world of `original` then names these. Errors: a map that is neither in the recording nor where
/// it was.
[[nodiscard]] Result<std::vector<PlayedScenario::File>> take_maps(
    config::ExpandedScenario& original);

}  // namespace rave::replay
