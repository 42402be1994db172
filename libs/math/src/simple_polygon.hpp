// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave::detail {

/// The outline of a polygon that was found to be simple, counter-clockwise, without repeated
/// vertices.
struct SimplePolygon {
  std::vector<Vec2> vertices;
  /// For each vertex its index in the caller's list.
  std::vector<std::size_t> source;
};

/// Twice the signed area would be exact only in real numbers; this one is taken about the first
/// vertex so that a small polygon far from the origin keeps its digits. m^2.
[[nodiscard]] double signed_area(std::span<const Vec2> vertices) noexcept;

/// Checks everything ConvexPolygon::make and decompose have in common.
[[nodiscard]] Result<SimplePolygon> check_simple(std::span<const Vec2> vertices,
                                                 std::size_t max_vertices);

/// The vertices less those at which the outline turns by less than 1e-9 rad.
[[nodiscard]] SimplePolygon without_collinear(SimplePolygon polygon);

}  // namespace rave::detail
