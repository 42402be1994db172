// SPDX-License-Identifier: Apache-2.0
#include "rave/math/pose_covariance.hpp"

#include <gtest/gtest.h>

#include <array>

#include "rave/math/transform.hpp"

namespace rave {
namespace {

using Arcs = std::array<double, 4>;  // length and turn of the first arc, then of the second

std::array<double, 3> end_of(const Arcs& arcs) {
  Pose2 pose{0, 0, 0.3};
  pose = integrate(pose, {arcs[0], 0, arcs[1]}, 1.0);
  pose = integrate(pose, {arcs[2], 0, arcs[3]}, 1.0);
  return {pose.x, pose.y, pose.yaw};
}

/// The derivative of the end of two arcs by each of their numbers, by differences.
std::array<std::array<double, 3>, 4> derivative(const Arcs& at) {
  constexpr double kStep = 1e-6;
  std::array<std::array<double, 3>, 4> result{};
  for (std::size_t i = 0; i < 4; ++i) {
    Arcs low = at;
    Arcs high = at;
    low[i] -= kStep;
    high[i] += kStep;
    for (std::size_t k = 0; k < 3; ++k) {
      result[i][k] = (end_of(high)[k] - end_of(low)[k]) / (2 * kStep);
    }
  }
  return result;
}

TEST(PoseCovariance, IsThatOfTheLinearisedMotion) {
  const Arcs arcs{1.5, 0.002, 0.8, -0.003};
  const std::array<ArcVariance, 2> noise{{{0.04, 0.09, 0.03}, {0.01, 0.16, -0.02}}};
  PoseCovariance told;
  double yaw_rad = 0.3;
  for (std::size_t arc = 0; arc < 2; ++arc) {
    told.grow(arcs[2 * arc], sincos(yaw_rad + 0.5 * arcs[2 * arc + 1]), noise[arc]);
    yaw_rad += arcs[2 * arc + 1];
  }
  const auto by = derivative(arcs);
  const auto expected = [&](std::size_t a, std::size_t b) {
    double sum = 0;
    for (std::size_t arc = 0; arc < 2; ++arc) {
      const auto& length = by[2 * arc];
      const auto& turn = by[2 * arc + 1];
      sum += noise[arc].length_m2 * length[a] * length[b] +
             noise[arc].turn_rad2 * turn[a] * turn[b] +
             noise[arc].length_turn_m_rad * (length[a] * turn[b] + turn[a] * length[b]);
    }
    return sum;
  };
  // The chord is taken to be as long as the arc: an error in proportion to the turns.
  EXPECT_NEAR(told.xx, expected(0, 0), 5e-5);
  EXPECT_NEAR(told.yy, expected(1, 1), 5e-5);
  EXPECT_NEAR(told.tt, expected(2, 2), 1e-9);
  EXPECT_NEAR(told.xy, expected(0, 1), 5e-5);
  EXPECT_NEAR(told.xt, expected(0, 2), 5e-5);
  EXPECT_NEAR(told.yt, expected(1, 2), 5e-5);
}

}  // namespace
}  // namespace rave
