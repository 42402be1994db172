// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rave::ros2 {

/// The type hash of ROS 2 (REP-2016) for a type by its wire name: `RIHS01_` and the SHA-256 of its
/// description; empty for unknown types. Pure; any thread.
[[nodiscard]] std::string_view type_hash_of(std::string_view wire_type) noexcept;

}  // namespace rave::ros2
