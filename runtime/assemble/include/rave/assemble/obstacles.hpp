// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/sim/engine_spec.hpp"

// Conversion of obstacles in files to those of the engine.
namespace rave::runtime {

/// The shapes of one outline at pose X_BO in its body.
[[nodiscard]] Result<std::vector<world::Shape>> shapes_of(const config::Outline& outline,
                                                          const Pose2& X_BO,
                                                          const config::HeightRange& z_m);
[[nodiscard]] Layer layer_of(config::ObstacleLayer layer);
/// Errors: kInvalidArgument with the place in the file.
[[nodiscard]] Result<world::Obstacle> make_obstacle(const config::ObstacleFile& file);

/// The change that an edit, which must not be empty, asks of the world. Errors: kInvalidArgument,
/// for an edit of a file with the place.
[[nodiscard]] Result<sim::ObstacleChange> change_of(const config::ObstacleEdit& edit);

/// Adds the obstacle changes of a scenario, by step. Errors: kNotFound (no such obstacle at any
/// time) and kInvalidArgument, with the place in the file.
Status add_obstacle_changes(const config::ExpandedScenario& scenario, sim::EngineSpec& spec);

/// The id, name, layer and pose of each existing obstacle, one per line.
[[nodiscard]] std::string list_obstacles(const world::WorldModel& world);

}  // namespace rave::runtime
