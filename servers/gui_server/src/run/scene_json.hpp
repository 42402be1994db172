// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/record/run_info.hpp"
#include "rave/world/body.hpp"

// What stands in the world and who drives in it, as the messages `scene` and `roster` say it.
namespace rave::gui_server {

/// Obstacles and walls of maps. Errors: a map that cannot be read.
[[nodiscard]] Result<std::string> bodies_of(const config::ExpandedScenario& scenario);

/// An obstacle of a run, as an entry of `bodies`.
[[nodiscard]] std::string body_json(std::uint32_t id, const world::Obstacle& obstacle);

/// An obstacle of a file, as an entry of `bodies`.
[[nodiscard]] std::string body_json(std::uint32_t id, const config::ObstacleFile& obstacle);

/// Robots with shapes and sensors. `hybrids`: names `robot/sensor` of hybrid sensors.
[[nodiscard]] std::string robots_of(const config::ExpandedScenario& scenario,
                                    const record::RunInfo& run, const record::StringMap& hybrids);

}  // namespace rave::gui_server
