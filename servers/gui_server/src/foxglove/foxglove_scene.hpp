// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rave/gui_server/source.hpp"

// Bodies and robots as `foxglove.SceneUpdate`, in JSON. Plain functions of what a source gives; SI
// units. The frame of the world is `world`, that of a robot `robot/NAME`.
namespace rave::gui_server {

/// The name of a robot's frame.
[[nodiscard]] std::string foxglove_frame(const std::string& robot);

/// An entry of the array `bodies` of a source: an entity that stands in the world.
[[nodiscard]] nlohmann::ordered_json body_entity(const nlohmann::ordered_json& body, double time_s);

/// An entry of the array `robots` of a source: an entity that moves with the robot's frame.
/// `flags`: those of its RobotState, of which the colour tells.
[[nodiscard]] nlohmann::ordered_json robot_entity(const nlohmann::ordered_json& robot,
                                                  std::uint16_t flags, double time_s);

/// What a message of a scene is put together of.
struct FoxgloveScene {
  bool anew = false;              ///< All entities of before go first.
  std::vector<std::string> gone;  ///< Ids.
  std::vector<nlohmann::ordered_json> entities;
};
[[nodiscard]] std::string scene_update(FoxgloveScene scene, double time_s);

/// `{"sec":1,"nsec":500000000}`
[[nodiscard]] nlohmann::ordered_json foxglove_stamp(double time_s);

/// A pose in the plane z_m above the floor.
[[nodiscard]] nlohmann::ordered_json foxglove_pose(double x_m, double y_m, double z_m,
                                                   double yaw_rad);

}  // namespace rave::gui_server
