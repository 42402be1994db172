// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/rank_tests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rave/base/random.hpp"

namespace rave::statistics {
namespace {

/// The mean rank of a value, from 1, by its definition.
double rank_of(const std::vector<double>& all, double value) {
  double below = 0;
  double equal = 0;
  for (const double other : all) {
    below += other < value ? 1 : 0;
    equal += other == value ? 1 : 0;
  }
  return below + (equal + 1) / 2;
}

/// Twice the smaller tail of a list of equally likely values.
double tails(const std::vector<double>& likely, double seen) {
  const auto size = static_cast<double>(likely.size());
  const auto below = static_cast<double>(
      std::ranges::count_if(likely, [&](double x) { return x <= seen + 1e-9; }));
  const auto above = static_cast<double>(
      std::ranges::count_if(likely, [&](double x) { return x >= seen - 1e-9; }));
  return std::min(1.0, 2 * std::min(below, above) / size);
}

/// All signs of the differences.
double enumerated_wilcoxon(const std::vector<double>& differences) {
  std::vector<double> sizes;
  std::vector<double> ranks;
  for (const double d : differences) sizes.push_back(std::abs(d));
  for (const double size : sizes) ranks.push_back(rank_of(sizes, size));
  std::vector<double> sums;
  double seen = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) seen += differences[i] > 0 ? ranks[i] : 0;
  for (std::uint32_t signs = 0; signs < (1U << ranks.size()); ++signs) {
    double sum = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i) sum += (signs >> i & 1U) != 0 ? ranks[i] : 0;
    sums.push_back(sum);
  }
  return tails(sums, seen);
}

/// All choices of values for the first sample.
double enumerated_mann_whitney(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::vector<double> sums;
  double seen = 0;
  for (const double value : a) seen += rank_of(all, value);
  for (std::uint32_t chosen = 0; chosen < (1U << all.size()); ++chosen) {
    if (static_cast<std::size_t>(std::popcount(chosen)) != a.size()) continue;
    double sum = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((chosen >> i & 1U) != 0) sum += rank_of(all, all[i]);
    }
    sums.push_back(sum);
  }
  return tails(sums, seen);
}

TEST(Wilcoxon, OfTheSmallestSamplesIsACount) {
  EXPECT_DOUBLE_EQ(wilcoxon(std::vector<double>{1, 2, 3, 4, 5, 6}).p, 2.0 / 64);
  EXPECT_DOUBLE_EQ(wilcoxon(std::vector<double>{3}).p, 1);
  EXPECT_DOUBLE_EQ(wilcoxon(std::vector<double>{0, 0}).p, 1);
  EXPECT_DOUBLE_EQ(wilcoxon({}).p, 1);
}

// Darwin's maize in eighths of an inch, as in Fisher, The Design of Experiments, 1935.
TEST(Wilcoxon, OfAPublishedExample) {
  const std::vector<double> maize = {49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48};
  const TestResult result = wilcoxon(maize);
  EXPECT_EQ(result.statistic, 96);
  EXPECT_NEAR(result.p, 0.04126, 5e-6);
  EXPECT_DOUBLE_EQ(result.p, enumerated_wilcoxon(maize));
}

TEST(RankTests, AgreeWithCompleteEnumeration) {
  for (std::uint32_t set = 0; set < 100; ++set) {
    RandomStream random(7, set, 0, 0);
    // Few different values, so that most sets have ties.
    const double values = set % 2 == 0 ? 4 : 1000;
    const auto value = [&] { return std::floor(random.uniform(0, values)); };
    std::vector<double> differences;
    for (std::uint32_t i = 0; i < 1 + set % 9; ++i) {
      differences.push_back((random.uniform() < 0.4 ? -1 : 1) * (1 + value()));
    }
    EXPECT_NEAR(wilcoxon(differences).p, enumerated_wilcoxon(differences), 1e-12) << set;
    std::vector<double> a;
    std::vector<double> b;
    for (std::uint32_t i = 0; i < 1 + set % 5; ++i) a.push_back(value());
    for (std::uint32_t i = 0; i < 1 + set % 4; ++i) b.push_back(value() + (set % 3 == 0 ? 2 : 0));
    EXPECT_NEAR(mann_whitney(a, b).p, enumerated_mann_whitney(a, b), 1e-12) << set;
    EXPECT_NEAR(mann_whitney(a, b).p, mann_whitney(b, a).p, 1e-12);
    EXPECT_DOUBLE_EQ(mann_whitney(a, b).statistic + mann_whitney(b, a).statistic,
                     static_cast<double>(a.size() * b.size()));
  }
}

TEST(RankTests, OfLargeSamplesAreNearTheExactOnes) {
  std::vector<double> fifty;
  for (int i = 1; i <= 50; ++i) fifty.push_back(i % 3 == 0 ? -i : i + 0.25);
  std::vector<double> more = fifty;
  more.push_back(1e-3);  // the least rank, which changes little
  EXPECT_TRUE(wilcoxon(fifty).exact);
  EXPECT_FALSE(wilcoxon(more).exact);
  EXPECT_NEAR(wilcoxon(fifty).p, wilcoxon(more).p, 0.002);
  std::vector<double> a(25);
  std::vector<double> b(25);
  for (int i = 0; i < 25; ++i) {
    a[static_cast<std::size_t>(i)] = i;
    b[static_cast<std::size_t>(i)] = i + 5.5;
  }
  const double exact = mann_whitney(a, b).p;
  b.push_back(17.5);  // the middle
  EXPECT_NEAR(mann_whitney(a, b).p, exact, 0.01);
}

TEST(RankTests, RejectWhatIsTrueAsOftenAsTheyMay) {
  int rejected = 0;
  for (std::uint32_t set = 0; set < 1000; ++set) {
    RandomStream random(11, set, 0, 0);
    std::vector<double> differences(12);
    for (double& d : differences) d = random.uniform(-1, 1);
    rejected += wilcoxon(differences).p < 0.05 ? 1 : 0;
  }
  EXPECT_GT(rejected, 20);
  EXPECT_LT(rejected, 71) << "50 and three standard deviations";
}

TEST(Holm, CorrectsInTheOrderOfTheProbabilities) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.005};
  const std::vector<double> corrected = holm(p);
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(corrected[i], expected[i], 1e-12);
  EXPECT_EQ(holm(std::vector<double>{0.7, 0.9}), (std::vector<double>{1, 1}));
  EXPECT_TRUE(holm({}).empty());
}

}  // namespace
}  // namespace rave::statistics
