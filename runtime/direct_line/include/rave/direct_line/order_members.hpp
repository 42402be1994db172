// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"
#include "rave/direct_line/json_members.hpp"

// What orders have in messages of pages to the GUI Server and on direct lines alike.
namespace rave::direct_line {

/// No world is as large; larger coordinates are mistakes.
inline constexpr double kFarthest_m = 1e6;
/// Largest size of a text to a robot or a user, bytes of UTF-8.
inline constexpr std::size_t kLongestText = 1000;

/// A pair of coordinates, for JsonMembers::list().
[[nodiscard]] Result<Vec2> point_of(const Json& pair, const char* name);

/// Reads the members of an order of kind `request.kind` for `robots` robots: velocities, points,
/// heading, speed or text. Errors: kParse with what was expected.
[[nodiscard]] Status read_order(JsonMembers& members, std::size_t robots,
                                runtime::RunRequest& request);

}  // namespace rave::direct_line
