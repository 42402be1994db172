// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "rave/math/convex_polygon.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/separation.hpp"

namespace rave::detail {

/// A polygon whose vertices and normals were transformed to another frame; lives on the stack.
struct PlacedPolygon {
  // Deliberately uninitialised: only the first `count` elements are read.
  std::array<double, ConvexPolygon::kMaxVertices> x;
  std::array<double, ConvexPolygon::kMaxVertices> y;
  std::array<double, ConvexPolygon::kMaxVertices> normal_x;
  std::array<double, ConvexPolygon::kMaxVertices> normal_y;
  std::size_t count;

  PlacedPolygon() noexcept {}  // NOLINT: see above

  void place(const ConvexPolygon& polygon, SinCos angle, Vec2 position) noexcept;

  [[nodiscard]] Vec2 vertex(std::size_t i) const noexcept { return {x[i], y[i]}; }
  [[nodiscard]] Vec2 normal(std::size_t i) const noexcept { return {normal_x[i], normal_y[i]}; }
};

/// rave::distance in the frame both polygons were placed in.
[[nodiscard]] Separation separate(const PlacedPolygon& a, const PlacedPolygon& b) noexcept;

}  // namespace rave::detail
