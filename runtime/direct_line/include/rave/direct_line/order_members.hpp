// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/direct_line/json_members.hpp"
#include "rave/request/order.hpp"

// What orders have in messages of pages to the GUI Server and on direct lines alike.
namespace rave::direct_line {

/// No world is as large; larger coordinates are mistakes.
inline constexpr double kFarthest_m = 1e6;
/// Largest size of a text to a robot or a user, bytes of UTF-8.
inline constexpr std::size_t kLongestText = 1000;

/// A pair of coordinates, for JsonMembers::list().
[[nodiscard]] Result<Vec2> point_of(const Json& pair, const char* name);

/// An order for several robots.
struct ReadOrder {
  request::Order order;
  /// Of a goal or a place, if each robot has its own: the points, in the order of the robots.
  std::vector<Vec2> points;
};
/// Reads the members of an order for `robots` robots: velocities, points, heading, speed or text.
/// Errors: kParse with what was expected.
[[nodiscard]] Result<ReadOrder> read_order(JsonMembers& members, OrderKind kind,
                                           std::size_t robots);

}  // namespace rave::direct_line
