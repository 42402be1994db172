// SPDX-License-Identifier: Apache-2.0
#include "simple_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "orientation.hpp"
#include "rave/math/convex_polygon.hpp"

namespace rave::detail {
namespace {

using EdgePair = std::pair<std::size_t, std::size_t>;

constexpr double kMinArea_m2 = 1.0e-9;
constexpr double kMinTurn_rad = 1.0e-9;

bool within_box(Vec2 p, Vec2 a, Vec2 b) noexcept {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// Whether the closed segments ab and cd have a point in common.
bool segments_meet(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  const int abc = orientation(a, b, c);
  const int abd = orientation(a, b, d);
  const int cda = orientation(c, d, a);
  const int cdb = orientation(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within_box(c, a, b)) || (abd == 0 && within_box(d, a, b)) ||
         (cda == 0 && within_box(a, c, d)) || (cdb == 0 && within_box(b, c, d));
}

/// Whether edges i < j of the outline share more than their common vertex.
bool edges_cross(std::span<const Vec2> v, std::size_t i, std::size_t j) noexcept {
  const std::size_t n = v.size();
  const auto at = [&](std::size_t k) { return v[k % n]; };
  const auto folds_back = [&](Vec2 before, Vec2 joint, Vec2 after) {
    return orientation(before, joint, after) == 0 && dot(joint - before, after - joint) < 0;
  };
  if (i + 1 == j) return folds_back(at(i), at(j), at(j + 1));
  if ((j + 1) % n == i) return folds_back(at(j), at(i), at(i + 1));
  return segments_meet(at(i), at(i + 1), at(j), at(j + 1));
}

/// The first pair of crossing edges, by index. Edges are swept in the order of their left ends, so
/// that only edges that overlap in x are compared.
std::optional<EdgePair> find_crossing(std::span<const Vec2> v) {
  const std::size_t n = v.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto left = [&](std::size_t i) { return std::min(v[i].x, v[(i + 1) % n].x); };
  const auto right = [&](std::size_t i) { return std::max(v[i].x, v[(i + 1) % n].x); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair(left(i), i) < std::pair(left(j), j);
  });
  std::optional<EdgePair> first;
  std::vector<std::size_t> active;
  for (const std::size_t j : order) {
    std::erase_if(active, [&](std::size_t i) { return right(i) < left(j); });
    const auto [low, high] = std::minmax(v[j].y, v[(j + 1) % n].y);
    for (const std::size_t i : active) {
      const auto [other_low, other_high] = std::minmax(v[i].y, v[(i + 1) % n].y);
      if (other_high < low || high < other_low) continue;
      const EdgePair pair = std::minmax(i, j);
      if (edges_cross(v, pair.first, pair.second) && (!first || pair < *first)) first = pair;
    }
    active.push_back(j);
  }
  return first;
}

Status check_vertices(std::span<const Vec2> vertices, std::size_t max_vertices) {
  if (vertices.size() < 3 || vertices.size() > max_vertices) {
    return fail(ErrorCode::kInvalidArgument, "a polygon has 3 to {} vertices, this one has {}",
                max_vertices, vertices.size());
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec2 v = vertices[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y)) {
      return fail(ErrorCode::kInvalidArgument, "polygon vertex {} is not finite: ({}, {})", i, v.x,
                  v.y);
    }
    if (std::max(std::abs(v.x), std::abs(v.y)) > ConvexPolygon::kMaxCoordinate_m) {
      return fail(ErrorCode::kInvalidArgument,
                  "polygon vertex {} lies beyond {} m from the origin: ({}, {})", i,
                  ConvexPolygon::kMaxCoordinate_m, v.x, v.y);
    }
  }
  return {};
}

}  // namespace

double signed_area(std::span<const Vec2> vertices) noexcept {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice += cross(vertices[i] - vertices[0], vertices[i + 1] - vertices[0]);
  }
  return 0.5 * twice;
}

Result<SimplePolygon> check_simple(std::span<const Vec2> vertices, std::size_t max_vertices) {
  RAVE_TRY(check_vertices(vertices, max_vertices));
  SimplePolygon polygon;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!polygon.vertices.empty() && polygon.vertices.back() == vertices[i]) continue;
    polygon.vertices.push_back(vertices[i]);
    polygon.source.push_back(i);
  }
  while (polygon.vertices.size() > 1 && polygon.vertices.back() == polygon.vertices.front()) {
    polygon.vertices.pop_back();
    polygon.source.pop_back();
  }
  if (polygon.vertices.size() < 3) {
    return fail(ErrorCode::kInvalidArgument, "a polygon needs 3 distinct vertices, this one has {}",
                polygon.vertices.size());
  }
  if (const auto pair = find_crossing(polygon.vertices)) {
    const auto ends = [&](std::size_t edge) {
      return fmt::format("edge {} (vertex {} to {})", polygon.source[edge], polygon.source[edge],
                         polygon.source[(edge + 1) % polygon.source.size()]);
    };
    return fail(ErrorCode::kInvalidArgument, "the polygon crosses or touches itself: {} and {}",
                ends(pair->first), ends(pair->second));
  }
  const double area_m2 = signed_area(polygon.vertices);
  if (!(std::abs(area_m2) > kMinArea_m2)) {
    return fail(ErrorCode::kInvalidArgument,
                "the polygon has an area of {} m^2, which is not above {} m^2", std::abs(area_m2),
                kMinArea_m2);
  }
  if (area_m2 < 0) {
    std::reverse(polygon.vertices.begin(), polygon.vertices.end());
    std::reverse(polygon.source.begin(), polygon.source.end());
  }
  return polygon;
}

SimplePolygon without_collinear(SimplePolygon polygon) {
  // Removing a vertex changes the turn at its neighbours, so remove one at a time.
  for (std::size_t i = 0; i < polygon.vertices.size() && polygon.vertices.size() > 2;) {
    const std::size_t n = polygon.vertices.size();
    const Vec2 in = polygon.vertices[i] - polygon.vertices[(i + n - 1) % n];
    const Vec2 out = polygon.vertices[(i + 1) % n] - polygon.vertices[i];
    const double limit = kMinTurn_rad * std::sqrt(squared_norm(in) * squared_norm(out));
    if (std::abs(cross(in, out)) > limit) {
      ++i;
      continue;
    }
    polygon.vertices.erase(polygon.vertices.begin() + static_cast<std::ptrdiff_t>(i));
    polygon.source.erase(polygon.source.begin() + static_cast<std::ptrdiff_t>(i));
    if (i > 0) --i;
  }
  return polygon;
}

}  // namespace rave::detail
