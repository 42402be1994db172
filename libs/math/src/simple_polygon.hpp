// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"

namespace rave::detail {

/// The outline of a simple polygon, counter-clockwise, without repeated vertices.
struct SimplePolygon {
  std::vector<Vec2> vertices;
  /// For each vertex its index in the caller's list.
  std::vector<std::size_t> source;
};

/// The signed area in m^2, relative to the first vertex, so that a small polygon far from the
/// origin keeps its precision.
[[nodiscard]] double signed_area(std::span<const Vec2> vertices) noexcept;

/// The checks common to ConvexPolygon::make and decompose.
[[nodiscard]] Result<SimplePolygon> check_simple(std::span<const Vec2> vertices,
                                                 std::size_t max_vertices);

/// The polygon without the vertices at which the outline turns by less than 1e-9 rad.
[[nodiscard]] SimplePolygon without_collinear(SimplePolygon polygon);

}  // namespace rave::detail
