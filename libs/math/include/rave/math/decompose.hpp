// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// Cuts any simple polygon (3 to 10000 vertices, either sense of rotation) into convex pieces that
/// do not overlap and fill it, except slivers below 1e-9 m^2. At most four times as many pieces as
/// necessary. Ear clipping with exact predicates, then merging across diagonals (Hertel and
/// Mehlhorn, "Fast triangulation of simple polygons", 1983). Same input, same pieces in the same
/// order. Errors as ConvexPolygon::make, without the demand to be convex.
[[nodiscard]] Result<std::vector<ConvexPolygon>> decompose(std::span<const Vec2> polygon);

}  // namespace rave
