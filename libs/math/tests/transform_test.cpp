// SPDX-License-Identifier: Apache-2.0
#include "rave/math/transform.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "rave/base/random.hpp"
#include "rave/math/finite.hpp"

namespace rave {
namespace {

Pose2 random_pose(RandomStream& random) {
  return {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-kPi, kPi)};
}

void expect_near(const Pose2& actual, const Pose2& expected, double bound) {
  ASSERT_NEAR(actual.x, expected.x, bound);
  ASSERT_NEAR(actual.y, expected.y, bound);
  ASSERT_NEAR(wrap_angle(actual.yaw - expected.yaw), 0, bound);
  ASSERT_GT(actual.yaw, -kPi);
  ASSERT_LE(actual.yaw, kPi);
}

TEST(Transform, QuarterTurn) {
  const Pose2 X_AB{1, 2, kPi / 2};
  const Vec2 p_AP = transform(X_AB, {3, 0});
  EXPECT_NEAR(p_AP.x, 1, 1e-15);
  EXPECT_NEAR(p_AP.y, 5, 1e-15);
  EXPECT_NEAR(rotate(kPi, {1, 0}).x, -1, 1e-15);
}

TEST(Transform, PosesAreAGroup) {
  RandomStream random(20, 0, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    const Pose2 X_AB = random_pose(random);
    const Pose2 X_BC = random_pose(random);
    const Pose2 X_CD = random_pose(random);
    expect_near(compose(compose(X_AB, X_BC), X_CD), compose(X_AB, compose(X_BC, X_CD)), 1e-13);
    expect_near(compose(X_AB, inverse(X_AB)), {}, 1e-13);
    expect_near(compose(inverse(X_AB), X_AB), {}, 1e-13);
    EXPECT_EQ(compose({}, X_AB), X_AB);
    const Vec2 p_C{random.uniform(-5, 5), random.uniform(-5, 5)};
    const Vec2 once = transform(compose(X_AB, X_BC), p_C);
    const Vec2 twice = transform(X_AB, transform(X_BC, p_C));
    ASSERT_LT(squared_norm(once - twice), 1e-26);
    ASSERT_LT(squared_norm(transform_back(X_AB, transform(X_AB, p_C)) - p_C), 1e-26);
  }
}

TEST(Interpolate, MeetsBothEndsAndTurnsTheShortWay) {
  const Pose2 X_0{0, 0, 3};
  const Pose2 X_1{2, 4, -3};
  EXPECT_EQ(interpolate(X_0, X_1, 0), X_0);
  EXPECT_EQ(interpolate(X_0, X_1, 1), X_1);
  expect_near(interpolate(X_0, X_1, 0.5), {1, 2, kPi}, 1e-14);
  expect_near(interpolate({0, 0, 0.2}, {0, 0, -0.2}, 0.25), {0, 0, 0.1}, 1e-14);
}

TEST(Integrate, FollowsTheCircle) {
  // A quarter of a circle of radius 2 to the left.
  expect_near(integrate({1, 1, 0}, {kPi, 0, kPi / 2}, 1), {3, 3, kPi / 2}, 1e-14);
  // Sideways motion too, and a full turn comes back.
  expect_near(integrate({1, 1, 0.3}, {0.7, -0.4, 2 * kPi}, 1), {1, 1, 0.3}, 1e-14);
  EXPECT_EQ(integrate({1, 1, 0}, {2, 1, 0}, 0.5), (Pose2{2, 1.5, 0}));
}

TEST(Integrate, IsSmoothTowardsStraightLines) {
  for (double wz = 0.1; wz > 1e-12; wz *= 0.7) {
    const Pose2 whole = integrate({}, {1, 0.5, wz}, 1);
    const Pose2 halves = integrate(integrate({}, {1, 0.5, wz}, 0.5), {1, 0.5, wz}, 0.5);
    expect_near(whole, halves, 1e-15);
  }
}

TEST(Integrate, AddsUpOverTime) {
  RandomStream random(21, 0, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    const Pose2 start = random_pose(random);
    const Twist2 v{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-5, 5)};
    Pose2 steps = start;
    for (int k = 0; k < 10; ++k) steps = integrate(steps, v, 0.05);
    expect_near(integrate(start, v, 0.5), steps, 1e-13);
  }
}

TEST(TwistBetween, UndoesIntegrate) {
  RandomStream random(22, 0, 0, 0);
  for (int i = 0; i < 5000; ++i) {
    const Pose2 X_0 = random_pose(random);
    const Pose2 X_1 = random_pose(random);
    expect_near(integrate(X_0, twist_between(X_0, X_1, 0.1), 0.1), X_1, 1e-12);
    const double scale = i % 2 == 0 ? 1.0 : 1e-5;
    const Twist2 v{random.uniform(-3, 3), random.uniform(-3, 3), scale * random.uniform(-5, 5)};
    const Twist2 back = twist_between(X_0, integrate(X_0, v, 0.5), 0.5);
    ASSERT_NEAR(back.vx, v.vx, 1e-12);
    ASSERT_NEAR(back.vy, v.vy, 1e-12);
    ASSERT_NEAR(back.wz, v.wz, 1e-12);
  }
}

TEST(Finite, LooksAtEachNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_finite(Vec2{1, -2}));
  EXPECT_TRUE(is_finite(Pose2{1, -2, 3}));
  EXPECT_TRUE(is_finite(Twist2{1, -2, 3}));
  for (const double bad : {nan, inf, -inf}) {
    for (const Vec2 p : {Vec2{bad, 0}, Vec2{0, bad}}) EXPECT_FALSE(is_finite(p));
    for (const Pose2 X : {Pose2{bad, 0, 0}, Pose2{0, bad, 0}, Pose2{0, 0, bad}}) {
      EXPECT_FALSE(is_finite(X));
    }
    for (const Twist2 v : {Twist2{bad, 0, 0}, Twist2{0, bad, 0}, Twist2{0, 0, bad}}) {
      EXPECT_FALSE(is_finite(v));
    }
  }
}

}  // namespace
}  // namespace rave
