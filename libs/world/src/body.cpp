// SPDX-License-Identifier: Apache-2.0
// Bodies of convex shapes. An outline of any form is decomposed once, when it is read.
#include "rave/world/body.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/decompose.hpp"
#include "rave/math/finite.hpp"

namespace rave::world {
namespace {

Status check_heights(double z0_m, double z1_m) {
  if (std::isfinite(z0_m) && std::isfinite(z1_m) && z0_m < z1_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "the height range must go from low to high, but is {} m to {} m", z0_m, z1_m);
}

}  // namespace

Result<std::vector<Shape>> make_prisms(std::span<const Vec2> outline, double z0_m, double z1_m) {
  RAVE_TRY(check_heights(z0_m, z1_m));
  RAVE_TRY_ASSIGN(const auto pieces, decompose(outline));
  std::vector<Shape> shapes;
  shapes.reserve(pieces.size());
  for (const ConvexPolygon& piece : pieces) {
    Shape shape;
    shape.kind = ShapeKind::kPolygon;
    shape.polygon = piece;
    shape.z0_m = z0_m;
    shape.z1_m = z1_m;
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

Result<Shape> make_disc(Vec2 centre, double radius_m, double z0_m, double z1_m) {
  RAVE_TRY(check_heights(z0_m, z1_m));
  if (!is_finite(centre) || !std::isfinite(radius_m) || radius_m <= 0) {
    return fail(ErrorCode::kInvalidArgument,
                "a disc needs a finite centre and a radius above 0, but has ({}, {}) and {} m",
                centre.x, centre.y, radius_m);
  }
  Shape shape;
  shape.centre = centre;
  shape.radius_m = radius_m;
  shape.z0_m = z0_m;
  shape.z1_m = z1_m;
  return shape;
}

double Body::radius_m() const noexcept {
  double radius = 0;
  for (const Shape& shape : shapes) {
    if (shape.kind == ShapeKind::kDisc) {
      radius = std::max(radius, std::sqrt(squared_norm(shape.centre)) + shape.radius_m);
    }
    for (const Vec2 v : shape.vertices()) radius = std::max(radius, std::sqrt(squared_norm(v)));
  }
  return radius;
}

Result<Body> scaled(const Body& body, double factor) {
  if (!std::isfinite(factor) || factor <= 0) {
    return fail(ErrorCode::kInvalidArgument, "a scale must be above 0, but is {}", factor);
  }
  Body result = body;
  for (Shape& shape : result.shapes) {
    shape.centre = factor * shape.centre;
    shape.radius_m *= factor;
    if (!shape.polygon) continue;
    std::vector<Vec2> corners(shape.vertices().begin(), shape.vertices().end());
    for (Vec2& corner : corners) corner = factor * corner;
    RAVE_TRY_ASSIGN(auto polygon, ConvexPolygon::make(corners));
    // make() joins corners that are too near to each other. The place of shapes in the snapshot has
    // room for the corners of the start.
    if (polygon.size() != corners.size()) {
      return fail(ErrorCode::kInvalidArgument, "scaled by {}, a shape of it loses corners", factor);
    }
    shape.polygon = std::move(polygon);
  }
  return result;
}

}  // namespace rave::world
