// SPDX-License-Identifier: Apache-2.0
#include "rave/math/separation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_shapes.hpp"
#include "rave/math/transform.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave {
namespace {

/// Distance by brute force: every vertex of one against the whole other.
double reference_gap(const ConvexPolygon& a, const Pose2& X_WA, const ConvexPolygon& b,
                     const Pose2& X_WB) {
  double best = 1e9;
  for (const Vec2 v : a.vertices()) {
    best = std::min(best, distance_to(b, transform_back(X_WB, transform(X_WA, v))));
  }
  for (const Vec2 v : b.vertices()) {
    best = std::min(best, distance_to(a, transform_back(X_WA, transform(X_WB, v))));
  }
  return best;
}

void expect_consistent(const Separation& found) {
  ASSERT_NEAR(squared_norm(found.normal_W), 1, 1e-14);
  const Vec2 gap = found.p_WB - found.p_WA - found.distance_m * found.normal_W;
  ASSERT_LT(squared_norm(gap), 1e-24);
}

TEST(Distance, FacesCornersAndOverlap) {
  const ConvexPolygon box = ConvexPolygon::box(2, 2).value();
  const Separation faces = distance(box, {0, 0, 0}, box, {3, 0.5, 0});
  EXPECT_DOUBLE_EQ(faces.distance_m, 1);
  EXPECT_EQ(faces.normal_W, (Vec2{1, 0}));
  EXPECT_EQ(faces.p_WA, (Vec2{1, 0.25}));
  EXPECT_EQ(faces.p_WB, (Vec2{2, 0.25}));
  const Separation corners = distance(box, {0, 0, 0}, box, {5, 6, 0});
  EXPECT_DOUBLE_EQ(corners.distance_m, 5);
  EXPECT_NEAR(corners.normal_W.x, 0.6, 1e-15);
  const Separation overlap = distance(box, {0, 0, 0}, box, {0.3, -1.75, 0});
  EXPECT_DOUBLE_EQ(overlap.distance_m, -0.25);
  EXPECT_EQ(overlap.normal_W, (Vec2{0, -1}));
}

TEST(Distance, AgreesWithBruteForce) {
  RandomStream random(40, 0, 0, 0);
  int apart = 0;
  int overlapping = 0;
  for (int i = 0; i < 10'000; ++i) {
    const ConvexPolygon a = random_convex(random, 1.0);
    const ConvexPolygon b = random_convex(random, random.uniform(0.1, 1.5));
    const Pose2 X_WA = random_pose(random, 2.0);
    const Pose2 X_WB = random_pose(random, 2.0);
    const Separation found = distance(a, X_WA, b, X_WB);
    expect_consistent(found);
    if (found.distance_m > 0) {
      ++apart;
      ASSERT_NEAR(found.distance_m, reference_gap(a, X_WA, b, X_WB), 1e-12);
      ASSERT_LT(distance_to(a, transform_back(X_WA, found.p_WA)), 1e-12);
      ASSERT_LT(distance_to(b, transform_back(X_WB, found.p_WB)), 1e-12);
    } else {
      ++overlapping;
      // Moved by the depth they just touch, by less they do not.
      const Vec2 out = -found.distance_m * found.normal_W;
      const Pose2 free{X_WB.x + out.x, X_WB.y + out.y, X_WB.yaw};
      ASSERT_NEAR(distance(a, X_WA, b, free).distance_m, 0, 1e-12);
      for (int k = 0; k < 8; ++k) {
        const Vec2 shift = -0.99 * found.distance_m * rotate(k * kPi / 4, Vec2{1, 0});
        const Pose2 moved{X_WB.x + shift.x, X_WB.y + shift.y, X_WB.yaw};
        ASSERT_LE(distance(a, X_WA, b, moved).distance_m, 0);
      }
    }
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(overlapping, 2000);
}

TEST(Distance, IsSymmetricAndKeepsItsDigitsFarAway) {
  RandomStream random(41, 0, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    const ConvexPolygon a = random_convex(random, 1.0);
    const ConvexPolygon b = random_convex(random, 0.5);
    const Pose2 X_WA = random_pose(random, 2.0);
    const Pose2 X_WB = random_pose(random, 2.0);
    const double there = distance(a, X_WA, b, X_WB).distance_m;
    ASSERT_NEAR(there, distance(b, X_WB, a, X_WA).distance_m, 1e-12);
    const Pose2 far_A{X_WA.x + 4096, X_WA.y - 8192, X_WA.yaw};
    const Pose2 far_B{X_WB.x + 4096, X_WB.y - 8192, X_WB.yaw};
    ASSERT_NEAR(there, distance(a, far_A, b, far_B).distance_m, 1e-11);
  }
}

TEST(DiscDistance, IsThatOfItsCenterLessTheRadius) {
  RandomStream random(42, 0, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    const ConvexPolygon a = random_convex(random, 1.0);
    const Pose2 X_WA = random_pose(random, 1.0);
    const Vec2 p_WC = random_pose(random, 3.0).position();
    const Separation found = distance(a, X_WA, p_WC, 0.25);
    expect_consistent(found);
    ASSERT_NEAR(found.distance_m, signed_distance(a, transform_back(X_WA, p_WC)) - 0.25, 1e-13);
    ASSERT_NEAR(signed_distance(a, transform_back(X_WA, found.p_WA)), 0, 1e-12);
    ASSERT_NEAR(std::sqrt(squared_norm(found.p_WB - p_WC)), 0.25, 1e-12);
  }
}

}  // namespace
}  // namespace rave
