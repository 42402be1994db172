// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave::gui_server {

/// The JSON Schema of a type of messages that a Foxglove client is sent: the members that RAVE
/// fills of `foxglove.SceneUpdate`, `foxglove.FrameTransforms`, `foxglove.PointCloud` and
/// `foxglove.Log`, and the types of RAVE itself, `rave.Poses` and `rave.Run`. There are no others.
/// Any thread.
[[nodiscard]] const std::string& foxglove_schema(std::string_view title);

}  // namespace rave::gui_server
