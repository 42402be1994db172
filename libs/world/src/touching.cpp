// SPDX-License-Identifier: Apache-2.0
// Distances and impacts of bodies that consist of several convex shapes: the least over all pairs
// of shapes whose heights overlap.
#include "rave/world/touching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::world {
namespace {

Separation disc_to_disc(Vec2 p_WA, double radius_a, Vec2 p_WB, double radius_b) noexcept {
  const Vec2 apart = p_WB - p_WA;
  const double distance = std::sqrt(squared_norm(apart));
  Separation result;
  result.normal_W = distance > 0 ? (1.0 / distance) * apart : Vec2{1, 0};
  result.distance_m = distance - radius_a - radius_b;
  result.p_WA = p_WA + radius_a * result.normal_W;
  result.p_WB = p_WB - radius_b * result.normal_W;
  return result;
}

Separation reversed(const Separation& s) noexcept {
  return {s.distance_m, -s.normal_W, s.p_WB, s.p_WA};
}

/// Most discs are centred on the origin of their body, so that its yaw does not matter.
Vec2 centre_in_world(const Shape& disc, const Pose2& X_WB) noexcept {
  return disc.centre == Vec2{} ? X_WB.position() : transform(X_WB, disc.centre);
}

bool heights_overlap(const Shape& a, const Shape& b) noexcept {
  return a.z0_m < b.z1_m && b.z0_m < a.z1_m;
}

/// The largest distance of a point of the shape from its body's origin, an upper bound of the lever
/// arm of a turn.
double reach(const Shape& shape) noexcept {
  if (shape.kind == ShapeKind::kDisc) return std::sqrt(squared_norm(shape.centre));
  return shape.polygon->bounding_radius();
}

/// Conservative advancement for pairs with a disc. B is convex, so it lies behind the plane through
/// its witness point. A is free until it reaches that plane, which it approaches no faster than by
/// the translation along the normal plus the turn times its reach.
Impact advance_to_impact(const Shape& a, const Pose2& X_WA, const Motion2& motion, const Shape& b,
                         const Pose2& X_WB, const ImpactLimits& limits) noexcept {
  constexpr int kMaxAdvances = 200;
  // A motion along the surface approaches it by rounding errors only; without this tolerance it
  // would stick.
  constexpr double kAlong_m = 1e-12;
  const double turn_bound = std::abs(motion.dyaw) * reach(a);
  double fraction = 0;
  Separation now = separation(a, X_WA, b, X_WB);
  for (int step = 0; step < kMaxAdvances; ++step) {
    const double approach = dot({motion.dx, motion.dy}, now.normal_W) + turn_bound - kAlong_m;
    const double room = now.distance_m - limits.skin_m;
    // An existing contact ends the motion only if the motion leads into it.
    const bool touching = room <= limits.tolerance_m;
    if (touching && approach > 0) return {fraction, now.normal_W, now.distance_m, true};
    // Not approaching: nothing can be reached in the rest of the motion.
    const double next = approach > 0 ? fraction + room / approach : 1;
    if (next >= 1) {
      const Separation end = separation(a, advance(X_WA, motion, 1), b, X_WB);
      return {1, end.normal_W, end.distance_m, false};
    }
    fraction = next;
    now = separation(a, advance(X_WA, motion, fraction), b, X_WB);
  }
  return {fraction, now.normal_W, now.distance_m, true};
}

Impact shape_impact(const Shape& a, const Pose2& X_WA, const Motion2& motion, const Shape& b,
                    const Pose2& X_WB, const ImpactLimits& limits) noexcept {
  if (a.polygon && b.polygon) {
    return rave::time_of_impact(*a.polygon, X_WA, motion, *b.polygon, X_WB, limits);
  }
  return advance_to_impact(a, X_WA, motion, b, X_WB, limits);
}

}  // namespace

Separation separation(const Shape& a, const Pose2& X_WA, const Shape& b,
                      const Pose2& X_WB) noexcept {
  // What passes over or under something never touches it.
  if (!heights_overlap(a, b)) {
    Separation apart;
    apart.distance_m = std::numeric_limits<double>::infinity();
    return apart;
  }
  if (a.polygon && b.polygon) return distance(*a.polygon, X_WA, *b.polygon, X_WB);
  if (a.polygon) return distance(*a.polygon, X_WA, centre_in_world(b, X_WB), b.radius_m);
  if (b.polygon) return reversed(distance(*b.polygon, X_WB, centre_in_world(a, X_WA), a.radius_m));
  return disc_to_disc(centre_in_world(a, X_WA), a.radius_m, centre_in_world(b, X_WB), b.radius_m);
}

Separation separation(const Body& a, const Pose2& X_WA, const Body& b, const Pose2& X_WB) noexcept {
  Separation least;
  least.distance_m = std::numeric_limits<double>::infinity();
  for (const Shape& shape_a : a.shapes) {
    for (const Shape& shape_b : b.shapes) {
      const Separation s = separation(shape_a, X_WA, shape_b, X_WB);
      if (s.distance_m < least.distance_m) least = s;
    }
  }
  return least;
}

Impact time_of_impact(const Body& a, const Pose2& X_WA, const Motion2& motion_W, const Body& b,
                      const Pose2& X_WB, const ImpactLimits& limits) noexcept {
  Impact first;
  first.distance_m = std::numeric_limits<double>::infinity();
  for (const Shape& shape_a : a.shapes) {
    for (const Shape& shape_b : b.shapes) {
      if (!heights_overlap(shape_a, shape_b)) continue;
      const Impact impact = shape_impact(shape_a, X_WA, motion_W, shape_b, X_WB, limits);
      const bool earlier = impact.hit && (!first.hit || impact.fraction < first.fraction);
      if (earlier) first = impact;
    }
  }
  return first;
}

}  // namespace rave::world
