// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// Decomposes a simple polygon (3 to 10000 vertices, either sense of rotation) into convex pieces
/// without overlaps. The pieces fill it except for slivers below 1e-9 m^2, and are at most four
/// times as many as necessary. Ear clipping with exact predicates, then merging across diagonals
/// (Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983). Deterministic, order
/// included. Errors: those of ConvexPolygon::make, except that a concave polygon is accepted.
[[nodiscard]] Result<std::vector<ConvexPolygon>> decompose(std::span<const Vec2> polygon);

}  // namespace rave
