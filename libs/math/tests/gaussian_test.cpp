// SPDX-License-Identifier: Apache-2.0
#include "rave/math/gaussian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace rave {
namespace {

TEST(Gaussian, HasTheMomentsAndTheShapeOfTheNormalDistribution) {
  constexpr int kCount = 100'000;
  std::vector<double> draws;
  for (std::uint32_t sample = 0; sample < kCount; ++sample) {
    RandomStream stream(11, 3, 2, sample);
    draws.push_back(gaussian(stream));
  }
  double mean = 0;
  for (const double x : draws) mean += x / kCount;
  double second = 0;
  double third = 0;
  double fourth = 0;
  for (const double x : draws) {
    const double d = x - mean;
    second += d * d / kCount;
    third += d * d * d / kCount;
    fourth += d * d * d * d / kCount;
  }
  // Five standard errors each: 1, 2, 6 and 24 over n.
  EXPECT_NEAR(mean, 0, 5 * std::sqrt(1.0 / kCount));
  EXPECT_NEAR(second, 1, 5 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(third / std::pow(second, 1.5), 0, 5 * std::sqrt(6.0 / kCount));
  EXPECT_NEAR(fourth / (second * second), 3, 5 * std::sqrt(24.0 / kCount));

  // Kolmogorov and Smirnov at the 0.1 % level: 1.95 / sqrt(n).
  std::sort(draws.begin(), draws.end());
  double gap = 0;
  for (int i = 0; i < kCount; ++i) {
    const double expected = 0.5 * std::erfc(-draws[static_cast<std::size_t>(i)] / std::sqrt(2.0));
    gap = std::max(
        {gap, std::abs(expected - 1.0 * i / kCount), std::abs(expected - (i + 1.0) / kCount)});
  }
  EXPECT_LT(gap, 1.95 / std::sqrt(kCount));
}

TEST(Gaussian, NeighbouringDrawsAreUncorrelated) {
  RandomStream stream(12, 0, 0, 0);
  constexpr int kCount = 100'000;
  double product = 0;
  double before = gaussian(stream);
  for (int i = 0; i < kCount; ++i) {
    const double now = gaussian(stream);
    product += before * now / kCount;
    before = now;
  }
  EXPECT_NEAR(product, 0, 5 / std::sqrt(kCount));
}

TEST(Gaussian, TakesTwoNumbersOfTheStream) {
  RandomStream drawn(13, 1, 1, 1);
  RandomStream skipped(13, 1, 1, 1);
  EXPECT_TRUE(std::isfinite(gaussian(drawn)));
  EXPECT_LT(skipped.uniform() + skipped.uniform(), 2);
  EXPECT_EQ(drawn.bits(), skipped.bits());
}

}  // namespace
}  // namespace rave
