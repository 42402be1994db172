// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

// JSON Schemas of the messages that a Foxglove client is sent: the members that RAVE fills of the
// types that Foxglove knows, and the types of RAVE itself. Immutable texts; any thread.
namespace rave::gui_server {

[[nodiscard]] const std::string& scene_update_schema();      ///< `foxglove.SceneUpdate`
[[nodiscard]] const std::string& frame_transforms_schema();  ///< `foxglove.FrameTransforms`
[[nodiscard]] const std::string& point_cloud_schema();       ///< `foxglove.PointCloud`
[[nodiscard]] const std::string& log_schema();               ///< `foxglove.Log`
[[nodiscard]] const std::string& poses_schema();             ///< `rave.Poses`
[[nodiscard]] const std::string& run_schema();               ///< `rave.Run`

}  // namespace rave::gui_server
