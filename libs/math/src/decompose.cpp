// SPDX-License-Identifier: Apache-2.0
#include "rave/math/decompose.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "orientation.hpp"
#include "simple_polygon.hpp"

namespace rave {
namespace {

using Loop = std::vector<std::uint32_t>;  ///< Vertex indices, counter-clockwise.
using Vertices = std::span<const Vec2>;

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) noexcept {
  return (static_cast<std::uint64_t>(from) << 32U) | to;
}

/// Cuts ears off a simple counter-clockwise polygon until it is empty.
class EarClipper {
 public:
  explicit EarClipper(Vertices vertices) : vertices_(vertices) {
    const auto n = static_cast<std::uint32_t>(vertices.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      previous_.push_back((i + n - 1) % n);
      next_.push_back((i + 1) % n);
    }
    for (std::uint32_t i = 0; i < n; ++i) {
      if (turn(i) < 0) reflex_.push_back(i);
    }
  }

  [[nodiscard]] std::vector<Loop> run() {
    std::vector<Loop> triangles;
    std::uint32_t at = 0;
    auto left = static_cast<std::uint32_t>(vertices_.size());
    std::uint32_t refused = 0;
    while (left > 3 && refused < left) {
      const int side = turn(at);
      const bool ear = side > 0 && is_ear(at);
      if (ear) triangles.push_back({previous_[at], at, next_[at]});
      if (ear || side == 0) {
        const std::uint32_t following = next_[at];
        unlink(at);
        --left;
        refused = 0;
        // Skipping one vertex avoids a fan of thin triangles about a single vertex.
        at = next_[following];
      } else {
        ++refused;
        at = next_[at];
      }
    }
    if (left == 3 && turn(at) > 0) triangles.push_back({previous_[at], at, next_[at]});
    return triangles;
  }

 private:
  [[nodiscard]] int turn(std::uint32_t i) const noexcept {
    return detail::orientation(vertices_[previous_[i]], vertices_[i], vertices_[next_[i]]);
  }

  /// It suffices to test reflex vertices: the first vertex inside a triangle is reflex.
  [[nodiscard]] bool is_ear(std::uint32_t i) const noexcept {
    const Vec2 a = vertices_[previous_[i]];
    const Vec2 b = vertices_[i];
    const Vec2 c = vertices_[next_[i]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    for (const std::uint32_t k : reflex_) {
      if (k == previous_[i] || k == next_[i]) continue;
      const Vec2 p = vertices_[k];
      if (p.x < low_x || p.x > high_x || p.y < low_y || p.y > high_y) continue;
      if (detail::orientation(a, b, p) >= 0 && detail::orientation(b, c, p) >= 0 &&
          detail::orientation(c, a, p) >= 0) {
        return false;
      }
    }
    return true;
  }

  void unlink(std::uint32_t i) {
    const std::uint32_t before = previous_[i];
    const std::uint32_t after = next_[i];
    next_[before] = after;
    previous_[after] = before;
    // Cutting an ear can only reduce the angles of its neighbours.
    std::erase_if(reflex_, [&](std::uint32_t k) {
      return k == i || ((k == before || k == after) && turn(k) >= 0);
    });
  }

  Vertices vertices_;
  std::vector<std::uint32_t> previous_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> reflex_;
};

/// Merges convex pieces across common edges while the result is convex.
class Merger {
 public:
  Merger(Vertices vertices, std::vector<Loop> pieces)
      : vertices_(vertices), pieces_(std::move(pieces)) {
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) claim_edges(p);
  }

  [[nodiscard]] std::vector<Loop> run() {
    const std::vector<Loop> triangles = pieces_;
    for (const Loop& triangle : triangles) {
      for (std::size_t k = 0; k < triangle.size(); ++k) {
        try_edge(triangle[k], triangle[(k + 1) % triangle.size()]);
      }
    }
    std::erase_if(pieces_, [](const Loop& loop) { return loop.empty(); });
    return std::move(pieces_);
  }

 private:
  void claim_edges(std::uint32_t piece) {
    const Loop& loop = pieces_[piece];
    for (std::size_t k = 0; k < loop.size(); ++k) {
      owner_[edge_key(loop[k], loop[(k + 1) % loop.size()])] = piece;
    }
  }

  /// The piece's vertices, starting at `first`.
  [[nodiscard]] Loop starting_at(std::uint32_t piece, std::uint32_t first) const {
    Loop loop = pieces_[piece];
    std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), first), loop.end());
    return loop;
  }

  void try_edge(std::uint32_t from, std::uint32_t to) {
    const auto mine = owner_.find(edge_key(from, to));
    const auto other = owner_.find(edge_key(to, from));
    if (mine == owner_.end() || other == owner_.end() || mine->second == other->second) return;
    const std::uint32_t kept = mine->second;
    const std::uint32_t given = other->second;
    // The vertices from `to` to `from` of one piece, then those between them of the other.
    Loop merged = starting_at(kept, to);
    const Loop rest = starting_at(given, from);
    if (merged.size() + rest.size() - 2 > ConvexPolygon::kMaxVertices) return;
    const std::size_t joint = merged.size() - 1;
    merged.insert(merged.end(), rest.begin() + 1, rest.end() - 1);
    if (!convex_at(merged, 0) || !convex_at(merged, joint)) return;
    owner_.erase(edge_key(from, to));
    owner_.erase(edge_key(to, from));
    pieces_[kept] = std::move(merged);
    pieces_[given].clear();
    claim_edges(kept);
  }

  [[nodiscard]] bool convex_at(const Loop& loop, std::size_t k) const noexcept {
    const std::size_t n = loop.size();
    return detail::orientation(vertices_[loop[(k + n - 1) % n]], vertices_[loop[k]],
                               vertices_[loop[(k + 1) % n]]) >= 0;
  }

  Vertices vertices_;
  std::vector<Loop> pieces_;
  /// The piece to the left of each directed edge. Only looked up, never iterated, so its order does
  /// not matter.
  std::unordered_map<std::uint64_t, std::uint32_t> owner_;
};

}  // namespace

Result<std::vector<ConvexPolygon>> decompose(std::span<const Vec2> polygon) {
  constexpr std::size_t kMaxGiven = 10'000;
  RAVE_TRY_ASSIGN(const auto simple, detail::check_simple(polygon, kMaxGiven));
  const Vertices vertices = simple.vertices;
  std::vector<ConvexPolygon> pieces;
  for (const Loop& loop : Merger(vertices, EarClipper(vertices).run()).run()) {
    std::vector<Vec2> corners;
    corners.reserve(loop.size());
    for (const std::uint32_t i : loop) corners.push_back(vertices[i]);
    // make() can refuse a piece here only because it is a sliver.
    if (auto piece = ConvexPolygon::make(corners)) pieces.push_back(*std::move(piece));
  }
  if (pieces.empty()) {
    return fail(ErrorCode::kInvalidArgument, "the polygon is nowhere wider than rounding errors");
  }
  return pieces;
}

}  // namespace rave
