// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "rave/config/scenario_file.hpp"

namespace rave::config {

/// The number of robots that an entry stands for.
[[nodiscard]] std::size_t robots_of(const RobotEntry& entry) noexcept;

/// The start pose of robot `i` of an entry; none if it is scattered or has no pose. The same on
/// every machine.
[[nodiscard]] std::optional<PoseFile> pose_of(const RobotEntry& entry, std::size_t i);

}  // namespace rave::config
