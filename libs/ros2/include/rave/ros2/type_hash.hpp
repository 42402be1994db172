// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rave::ros2 {

/// What ROS 2 calls a version of a type (REP-2016): `RIHS01_` and a SHA-256 of its description,
/// by the name that the type has on the wire; empty for a type that is not ours. Pure; any thread.
[[nodiscard]] std::string_view type_hash_of(std::string_view wire_type) noexcept;

}  // namespace rave::ros2
