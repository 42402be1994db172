// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "rave/robot/reading.hpp"

namespace rave::sim {

/// A record of a sensor that says where its robot is, as a pose.
[[nodiscard]] PoseReading pose_reading(ReadingKind kind, const std::byte* record);

}  // namespace rave::sim
