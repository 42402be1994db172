// SPDX-License-Identifier: Apache-2.0
#include "rave/math/decompose.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "random_shapes.hpp"
#include "rave/math/separation.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave {
namespace {

double outline_area(const std::vector<Vec2>& v) {
  double twice = 0;
  for (std::size_t i = 0; i < v.size(); ++i) twice += cross(v[i], v[(i + 1) % v.size()]);
  return 0.5 * std::abs(twice);
}

/// Even-odd rule; not meant for points on the outline.
bool inside_outline(const std::vector<Vec2>& v, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec2 a = v[i];
    const Vec2 b = v[(i + 1) % v.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// Pieces fill the outline exactly once.
void expect_partition(const std::vector<Vec2>& outline, RandomStream& random, int probes) {
  const auto pieces = decompose(outline);
  ASSERT_TRUE(pieces) << pieces.error().text();
  double covered = 0;
  for (const ConvexPolygon& piece : *pieces) {
    covered += area(piece);
    Vec2 middle;
    for (const Vec2 v : piece.vertices()) middle = middle + (1.0 / double(piece.size())) * v;
    ASSERT_TRUE(inside_outline(outline, middle));
  }
  ASSERT_NEAR(covered, outline_area(outline), 1e-9 * static_cast<double>(outline.size()));
  for (int i = 0; i < probes; ++i) {
    const Vec2 p = random_pose(random, 1.0).position();
    int holders = 0;
    for (const ConvexPolygon& piece : *pieces) holders += piece.contains(p) ? 1 : 0;
    ASSERT_EQ(holders, inside_outline(outline, p) ? 1 : 0) << p.x << " " << p.y;
  }
}

TEST(Decompose, LeavesConvexPolygonsWhole) {
  const std::vector<Vec2> square = {{0, 0}, {0, 1}, {0.5, 1}, {1, 1}, {1, 0}};
  const auto pieces = decompose(square).value();
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].size(), 4U);
}

TEST(Decompose, CutsAnLInTwo) {
  const std::vector<Vec2> ell = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const auto pieces = decompose(ell).value();
  EXPECT_EQ(pieces.size(), 2U);
  EXPECT_DOUBLE_EQ(area(pieces[0]) + area(pieces[1]), 3);
}

TEST(Decompose, FillsRandomStars) {
  RandomStream random(50, 0, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    auto star = random_star(random, 4 + static_cast<int>(random.bits() % 60));
    if (i % 2 == 0) std::reverse(star.begin(), star.end());
    expect_partition(star, random, 10);
  }
}

TEST(Decompose, FillsCombsWithCollinearTeeth) {
  RandomStream random(51, 0, 0, 0);
  for (int teeth = 1; teeth < 60; ++teeth) {
    const double width = 1.8 / (2 * teeth);
    std::vector<Vec2> comb = {{-0.9, -0.9}, {0.9, -0.9}};
    for (int k = 2 * teeth; k > 0; --k) {
      const double high = k % 2 == 0 ? 0.5 : -0.5;
      comb.push_back({-0.9 + k * width, high});
      comb.push_back({-0.9 + (k - 1) * width, high});
    }
    expect_partition(comb, random, 20);
  }
}

TEST(Decompose, KeepsToTheBoundOfHertelAndMehlhorn) {
  RandomStream random(52, 0, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const auto star = random_star(random, 40);
    std::size_t reflex = 0;
    for (std::size_t k = 0; k < star.size(); ++k) {
      const Vec2 in = star[k] - star[(k + 39) % 40];
      if (cross(in, star[(k + 1) % 40] - star[k]) < 0) ++reflex;
    }
    // No diagonal is left that is not needed by one of its ends: at most two for each reflex one.
    ASSERT_LE(decompose(star).value().size(), 2 * reflex + 1);
  }
}

TEST(Decompose, TakesTenThousandVertices) {
  RandomStream random(53, 0, 0, 0);
  expect_partition(random_star(random, 10'000), random, 20);
}

TEST(Decompose, SaysWhichEdgesCross) {
  const std::vector<Vec2> crossing = {{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}};
  EXPECT_EQ(decompose(crossing).error().text(),
            "the polygon crosses or touches itself: edge 0 (vertex 0 to 1) and edge 2 (vertex 2 to "
            "3)");
  const std::vector<Vec2> touching = {{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}};
  EXPECT_NE(decompose(touching).error().text().find("edge 0 (vertex 0 to 1) and edge 2"),
            std::string::npos);
  EXPECT_EQ(decompose(std::vector<Vec2>(10'001)).error().text(),
            "a polygon has 3 to 10000 vertices, this one has 10001");
}

}  // namespace
}  // namespace rave
