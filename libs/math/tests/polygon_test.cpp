// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "random_shapes.hpp"
#include "rave/math/convex_polygon.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

std::string error_of(const std::vector<Vec2>& vertices) {
  const auto polygon = ConvexPolygon::make(vertices);
  return polygon ? "accepted" : polygon.error().text();
}

TEST(ConvexPolygon, BoxHasItsMeasures) {
  const ConvexPolygon box = ConvexPolygon::box(2, 1).value();
  EXPECT_EQ(box.size(), 4U);
  EXPECT_DOUBLE_EQ(area(box), 2);
  EXPECT_DOUBLE_EQ(box.bounding_radius(), std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(box.bounding_radius({1, 0.5}), std::sqrt(5));
  EXPECT_TRUE(box.contains({1, 0.5}));
  EXPECT_FALSE(box.contains({1.001, 0}));
  EXPECT_DOUBLE_EQ(distance_to(box, {4, 4.5}), 5);
  EXPECT_EQ(distance_to(box, {0.9, 0}), 0);
  EXPECT_NEAR(signed_distance(box, {0.9, 0}), -0.1, 1e-15);
}

TEST(ConvexPolygon, RegularPolygonApproachesItsCircle) {
  const ConvexPolygon polygon = regular_polygon(64, 2);
  EXPECT_EQ(polygon.size(), 64U);
  EXPECT_NEAR(area(polygon), 32 * 4 * std::sin(2 * kPi / 64), 1e-12);
  EXPECT_NEAR(polygon.bounding_radius(), 2, 1e-14);
}

TEST(ConvexPolygon, TidiesItsInput) {
  // Clockwise, with a repeated vertex, a closing vertex and one in the middle of an edge.
  const std::vector<Vec2> untidy = {{0, 0}, {0, 1}, {0, 1}, {1, 1}, {1, 0.5}, {1, 0}, {0, 0}};
  const ConvexPolygon polygon = ConvexPolygon::make(untidy).value();
  EXPECT_EQ(polygon.size(), 4U);
  EXPECT_DOUBLE_EQ(area(polygon), 1);
}

TEST(ConvexPolygon, SaysWhatIsWrong) {
  EXPECT_EQ(error_of({{0, 0}, {1, 0}}), "a polygon has 3 to 10000 vertices, this one has 2");
  EXPECT_EQ(error_of({{0, 0}, {1, 0}, {0, 0}, {0, 0}}),
            "a polygon needs 3 distinct vertices, this one has 2");
  EXPECT_EQ(error_of({{0, 0}, {1, 0}, {0, kEndless}}), "polygon vertex 2 is not finite: (0, inf)");
  EXPECT_EQ(error_of({{0, 0}, {std::nan(""), 0}, {0, 1}}),
            "polygon vertex 1 is not finite: (nan, 0)");
  EXPECT_EQ(error_of({{0, 0}, {2e9, 0}, {0, 1}}),
            "polygon vertex 1 lies beyond 1000000000 m from the origin: (2000000000, 0)");
  EXPECT_EQ(error_of({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
            "the polygon crosses or touches itself: edge 0 (vertex 0 to 1) and edge 2 (vertex 2 to "
            "3)");
  EXPECT_EQ(error_of({{0, 0}, {0, 0}, {1, 1}, {1, 0}, {0, 1}}),
            "the polygon crosses or touches itself: edge 0 (vertex 0 to 2) and edge 3 (vertex 3 to "
            "4)");
  EXPECT_EQ(error_of({{0, 0}, {2, 0}, {1, 0}, {1, 1}}),
            "the polygon crosses or touches itself: edge 0 (vertex 0 to 1) and edge 1 (vertex 1 to "
            "2)");
  EXPECT_EQ(error_of({{0, 0}, {1e-5, 0}, {0, 1e-5}}),
            "the polygon has an area of 5.000000000000001e-11 m^2, which is not above 1e-09 m^2");
  EXPECT_EQ(error_of({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}}),
            "the polygon is not convex: it turns inwards at vertex 3");
  std::vector<Vec2> many;
  for (int i = 0; i < 65; ++i) many.push_back({cos(2 * kPi * i / 65), sin(2 * kPi * i / 65)});
  EXPECT_EQ(error_of(many), "a convex polygon has at most 64 vertices, this one has 65");
  EXPECT_EQ(ConvexPolygon::box(1, -1).error().text(),
            "length and width of a box are positive, not 1 and -1 m");
}

TEST(ConvexPolygon, PentagramIsNotSimpleAlthoughItAlwaysTurnsLeft) {
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i) star.push_back({cos(4 * kPi * i / 5), sin(4 * kPi * i / 5)});
  EXPECT_NE(error_of(star).find("crosses or touches itself: edge 0"), std::string::npos);
}

TEST(CastRay, HitsABox) {
  const ConvexPolygon box = ConvexPolygon::box(2, 2).value();
  EXPECT_DOUBLE_EQ(cast_ray({-3, 0.5}, {1, 0}, box), 2);
  EXPECT_EQ(cast_ray({-3, 1.5}, {1, 0}, box), kEndless);
  EXPECT_EQ(cast_ray({3, 0}, {1, 0}, box), kEndless);
  EXPECT_EQ(cast_ray({0.3, 0}, {1, 0}, box), 0);
}

TEST(CastRay, EndsOnTheBorderAndNotBefore) {
  RandomStream random(30, 0, 0, 0);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const ConvexPolygon polygon = random_convex(random, 1.0);
    const Vec2 origin{random.uniform(-3, 3), random.uniform(-3, 3)};
    const SinCos heading = sincos(random.uniform(-kPi, kPi));
    const Vec2 direction{heading.cos, heading.sin};
    const double range_m = cast_ray(origin, direction, polygon);
    double nearest = kEndless;
    for (int k = 0; k <= 200; ++k) {
      nearest = std::min(nearest, distance_to(polygon, origin + 0.04 * k * direction));
    }
    if (std::isinf(range_m)) {
      ASSERT_GT(nearest, 0);
      continue;
    }
    ++hits;
    ASSERT_LT(distance_to(polygon, origin + range_m * direction), 1e-12);
    ASSERT_EQ(range_m == 0, polygon.contains(origin));
    ASSERT_EQ(distance_to(polygon, origin + 0.999 * range_m * direction) > 0, range_m > 0);
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace rave
