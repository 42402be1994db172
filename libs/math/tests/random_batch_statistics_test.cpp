// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "rave/math/random_batch.hpp"

namespace rave {
namespace {

double below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// What is wrong with `draws` as independent draws of the standard normal distribution, each check
/// with five standard errors of its statistic. Seeds are fixed, so a pass is a pass for ever.
std::string flaws_of_moments(const std::vector<float>& draws) {
  const double n = static_cast<double>(draws.size());
  double sums[5] = {};
  for (const float draw : draws) {
    const double x = draw;
    sums[1] += x;
    sums[2] += x * x;
    sums[3] += x * x * x;
    sums[4] += x * x * x * x;
  }
  std::string flaws;
  // Variances of the powers of a normal number: 1, 2, 15 and 96.
  if (std::abs(sums[1] / n) > 5 * std::sqrt(1 / n)) flaws += "mean ";
  if (std::abs(sums[2] / n - 1) > 5 * std::sqrt(2 / n)) flaws += "variance ";
  if (std::abs(sums[3] / n) > 5 * std::sqrt(15 / n)) flaws += "skewness ";
  if (std::abs(sums[4] / n - 3) > 5 * std::sqrt(96 / n)) flaws += "kurtosis ";
  return flaws;
}

std::string flaws_of_shape(std::vector<float> draws) {
  const double n = static_cast<double>(draws.size());
  std::string flaws;
  std::sort(draws.begin(), draws.end());
  double gap = 0;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const double expected = below(draws[i]);
    const auto rank = static_cast<double>(i);
    gap = std::max({gap, std::abs(expected - rank / n), std::abs(expected - (rank + 1) / n)});
  }
  // Kolmogorov and Smirnov at the 0.1 % level.
  if (gap > 1.95 / std::sqrt(n)) flaws += "distribution ";
  // Chi squared over 100 bins of equal probability: mean 99, variance 198.
  std::vector<double> bins(100);
  for (const float draw : draws) {
    ++bins[std::min<std::size_t>(99, static_cast<std::size_t>(below(draw) * 100))];
  }
  double chi2 = 0;
  for (const double count : bins) chi2 += (count - n / 100) * (count - n / 100) / (n / 100);
  if (std::abs(chi2 - 99) > 5 * std::sqrt(198.0)) flaws += "bins ";
  for (const double bound : {3.0, 4.0, 4.5}) {
    const auto bound_f = static_cast<float>(bound);
    const auto low = std::lower_bound(draws.begin(), draws.end(), -bound_f) - draws.begin();
    const auto high = draws.end() - std::upper_bound(draws.begin(), draws.end(), bound_f);
    const double expected = n * below(-bound);
    for (const auto count : {low, high}) {
      if (std::abs(static_cast<double>(count) - expected) > 5 * std::sqrt(expected)) {
        flaws += "tail ";
      }
    }
  }
  return flaws;
}

/// Correlation of a[i] with b[i], of their squares, and of each with the other's square.
std::string flaws_of_pairs(std::span<const float> a, std::span<const float> b) {
  const double n = static_cast<double>(a.size());
  double product = 0;
  double squares = 0;
  double mixed = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double x = a[i];
    const double y = b[i];
    product += x * y;
    squares += (x * x - 1) * (y * y - 1) / 2;
    mixed += (x * (y * y - 1) + y * (x * x - 1)) / 2;
  }
  std::string flaws;
  if (std::abs(product / std::sqrt(n)) > 5) flaws += "correlation ";
  if (std::abs(squares / std::sqrt(n)) > 5) flaws += "magnitudes ";
  if (std::abs(mixed / std::sqrt(n)) > 5) flaws += "mixed ";
  return flaws;
}

constexpr std::uint32_t kRays = 180;

std::vector<float> reading(std::uint64_t seed, std::uint32_t robot, std::uint32_t device,
                           std::uint32_t sample) {
  std::vector<float> draws(kRays);
  fill_normal(RandomStream(seed, robot, device, sample), draws);
  return draws;
}

/// Readings of many robots, samples, devices and seeds, of kRays draws each.
template <class Make>
std::vector<float> readings(std::uint32_t count, const Make& make) {
  std::vector<float> all;
  all.reserve(std::size_t{count} * kRays);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<float> one = make(i);
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

std::vector<float> of_robots(std::uint32_t count) {
  return readings(count, [](std::uint32_t i) { return reading(5, i, 0x80000000U, 17); });
}
std::vector<float> of_samples(std::uint32_t count) {
  return readings(count, [](std::uint32_t i) { return reading(5, 3, 0x80000000U, i); });
}
std::vector<float> of_devices(std::uint32_t count) {
  return readings(count, [](std::uint32_t i) { return reading(5, 3, i, 17); });
}
std::vector<float> of_seeds(std::uint32_t count) {
  return readings(count, [](std::uint32_t i) { return reading(i, 3, 0x80000000U, 17); });
}

TEST(FillNormal, HasTheMomentsOfTheNormalDistribution) {
  std::vector<float> long_one(10'000'000);
  fill_normal(RandomStream(4, 3, 2, 1), long_one);
  EXPECT_EQ(flaws_of_moments(long_one), "");
  EXPECT_EQ(flaws_of_moments(of_robots(20'000)), "");
  EXPECT_EQ(flaws_of_moments(of_samples(20'000)), "");
  EXPECT_EQ(flaws_of_moments(of_devices(20'000)), "");
  EXPECT_EQ(flaws_of_moments(of_seeds(20'000)), "");
}

TEST(FillNormal, HasTheShapeAndTheTailsOfTheNormalDistribution) {
  std::vector<float> long_one(2'000'000);
  fill_normal(RandomStream(6, 3, 2, 1), long_one);
  EXPECT_EQ(flaws_of_shape(std::move(long_one)), "");
  EXPECT_EQ(flaws_of_shape(of_robots(5000)), "");
  EXPECT_EQ(flaws_of_shape(of_samples(5000)), "");
}

TEST(FillNormal, NeighbouringRaysAreIndependent) {
  const std::vector<float> draws = of_robots(10'000);
  for (std::size_t lag = 1; lag <= 8; ++lag) {
    const std::span all(draws);
    EXPECT_EQ(flaws_of_pairs(all.first(all.size() - lag), all.subspan(lag)), "") << lag;
  }
  // Both of a Box-Muller pair, and the second of one with the first of the next.
  for (const std::size_t start : {0U, 1U}) {
    std::vector<float> first;
    std::vector<float> second;
    for (std::size_t i = start; i + 1 < draws.size(); i += 2) {
      first.push_back(draws[i]);
      second.push_back(draws[i + 1]);
    }
    EXPECT_EQ(flaws_of_pairs(first, second), "") << start;
  }
}

TEST(FillNormal, RobotsSamplesDevicesAndSeedsAreIndependent) {
  for (const auto& draws :
       {of_robots(10'000), of_samples(10'000), of_devices(10'000), of_seeds(10'000)}) {
    const std::span all(draws);
    for (const std::size_t lag : {1U, 2U, 256U}) {
      const std::size_t shift = lag * kRays;
      EXPECT_EQ(flaws_of_pairs(all.first(all.size() - shift), all.subspan(shift)), "") << lag;
    }
  }
  const std::vector<float> robots = of_robots(5000);
  EXPECT_EQ(flaws_of_pairs(robots, of_samples(5000)), "");
  // Normal numbers and drop-out of one sample.
  const auto words = readings(5000, [](std::uint32_t i) {
    std::vector<std::uint32_t> bits(kRays);
    fill_bits(RandomStream(5, i, 0x80000000U, 17).at_block(0x80000000U), bits);
    std::vector<float> uniform(kRays);
    for (std::size_t k = 0; k < kRays; ++k) {
      uniform[k] = (static_cast<float>(bits[k]) * 0x1p-32F - 0.5F) * std::sqrt(12.0F);
    }
    return uniform;
  });
  EXPECT_EQ(flaws_of_pairs(robots, words), "");
}

TEST(FillNormal, TheChecksFindBadGenerators) {
  std::vector<float> good(2'000'000);
  fill_normal(RandomStream(6, 3, 2, 1), good);
  const auto changed = [&](auto change) {
    std::vector<float> bad = good;
    for (std::size_t i = 0; i < bad.size(); ++i) bad[i] = change(bad[i], i);
    return bad;
  };
  const auto contains = [](const std::string& flaws, const char* flaw) {
    return flaws.find(flaw) != std::string::npos;
  };
  const auto shifted = changed([](float x, std::size_t) { return x + 0.005F; });
  EXPECT_TRUE(contains(flaws_of_moments(shifted), "mean"));
  EXPECT_TRUE(contains(flaws_of_shape(shifted), "distribution"));
  const auto wide = changed([](float x, std::size_t) { return 1.01F * x; });
  EXPECT_TRUE(contains(flaws_of_moments(wide), "variance"));
  EXPECT_TRUE(contains(flaws_of_shape(wide), "bins"));
  const auto cut = changed([](float x, std::size_t) { return std::clamp(x, -3.9F, 3.9F); });
  EXPECT_TRUE(contains(flaws_of_shape(cut), "tail"));
  const auto skew = changed([](float x, std::size_t) { return x + 0.01F * (x * x - 1); });
  EXPECT_TRUE(contains(flaws_of_moments(skew), "skewness"));
  const auto heavy = changed([](float x, std::size_t i) { return i % 2 == 0 ? x : 1.2F * x; });
  EXPECT_TRUE(contains(flaws_of_moments(heavy), "kurtosis"));
  const std::span all(good);
  const auto before = all.first(all.size() - 1);
  const auto after = all.subspan(1);
  const auto mixed = changed([&](float x, std::size_t i) { return x + 0.01F * good[i / 2 * 2]; });
  EXPECT_TRUE(contains(flaws_of_pairs(all, mixed), "correlation"));
  EXPECT_EQ(flaws_of_pairs(before, after), "");
  // A common magnitude, as of a Box-Muller pair whose radius is not that of the formula.
  std::vector<float> first;
  std::vector<float> second;
  for (std::size_t i = 0; i + 2 < good.size(); i += 3) {
    const float scale = 1 + 0.2F * good[i + 2];
    first.push_back(good[i] * scale);
    second.push_back(good[i + 1] * scale);
  }
  EXPECT_TRUE(contains(flaws_of_pairs(first, second), "magnitudes"));
  std::vector<float> squared;
  for (const float x : good) squared.push_back(0.9F * x + 0.1F * (x * x - 1));
  EXPECT_TRUE(contains(flaws_of_pairs(good, squared), "mixed"));
}

}  // namespace
}  // namespace rave
