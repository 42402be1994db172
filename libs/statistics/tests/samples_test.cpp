// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rave/base/random.hpp"

namespace rave::statistics {
namespace {

TEST(Samples, HaveCentresAndQuantiles) {
  const std::vector<double> values = {9, 1, 4, 2};
  EXPECT_DOUBLE_EQ(mean(values), 4);
  EXPECT_DOUBLE_EQ(median(values), 3);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile(values, 1), 9);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(38.0 / 3));
  EXPECT_DOUBLE_EQ(standard_deviation(std::vector<double>{7}), 0);
}

TEST(Bootstrap, OfOneValueIsThatValue) {
  const Interval interval = bootstrap(std::vector<double>{7}, Centre::kMean);
  EXPECT_EQ(interval.low, 7);
  EXPECT_EQ(interval.high, 7);
}

TEST(Bootstrap, IntervalsHaveTheMeanAsOftenAsTheySay) {
  int within = 0;
  for (std::uint32_t set = 0; set < 400; ++set) {
    RandomStream random(3, set, 0, 0);
    std::vector<double> values(25);
    // A sum of twelve is normal enough.
    for (double& value : values) {
      for (int i = 0; i < 12; ++i) value += random.uniform(-0.5, 0.5);
    }
    const Interval interval = bootstrap(values, Centre::kMean, 0.95, set);
    EXPECT_LE(interval.low, interval.estimate);
    EXPECT_GE(interval.high, interval.estimate);
    within += interval.low <= 0 && interval.high >= 0 ? 1 : 0;
  }
  // 93.5 % of 400 are expected of percentile intervals of 25 values, and a standard deviation is 5.
  EXPECT_GT(within, 355);
  EXPECT_LT(within, 393);
}

}  // namespace
}  // namespace rave::statistics
