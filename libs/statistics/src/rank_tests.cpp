// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/rank_tests.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace rave::statistics {
namespace {

constexpr std::size_t kMostExact = 50;

/// Ranks of values from 1, equal ones with the mean of theirs. Doubled, so that they are whole.
struct Ranks {
  std::vector<std::size_t> doubled;
  double ties = 0;  ///< The sum of t^3 - t over groups of t equal values.
};

Ranks ranks_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  Ranks ranks;
  ranks.doubled.resize(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t i = begin; i < end; ++i) ranks.doubled[order[i]] = begin + end + 1;
    const auto count = static_cast<double>(end - begin);
    ranks.ties += count * count * count - count;
    begin = end;
  }
  return ranks;
}

double normal_p(double difference, double variance) {
  if (variance <= 0) return 1;
  const double z = std::max(std::abs(difference) - 0.5, 0.0) / std::sqrt(variance);
  return std::erfc(z / std::sqrt(2.0));
}

/// Twice the smaller tail of a distribution that is given by counts.
double two_sided(const std::vector<double>& counts, std::size_t at) {
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(at);
  const double below = std::accumulate(counts.begin(), middle + 1, 0.0);
  const double above = std::accumulate(middle, counts.end(), 0.0);
  return std::min(1.0, 2 * std::min(below, above) / all);
}

}  // namespace

TestResult wilcoxon(std::span<const double> differences) {
  std::vector<double> sizes;
  std::vector<bool> positive;
  for (const double difference : differences) {
    if (difference == 0) continue;
    sizes.push_back(std::abs(difference));
    positive.push_back(difference > 0);
  }
  const Ranks ranks = ranks_of(sizes);
  const std::size_t most =
      std::accumulate(ranks.doubled.begin(), ranks.doubled.end(), std::size_t{0});
  std::size_t sum = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) sum += positive[i] ? ranks.doubled[i] : 0;
  TestResult result{static_cast<double>(sum) / 2, 1, sizes.size() <= kMostExact};
  if (sizes.empty()) return result;
  if (!result.exact) {
    const auto n = static_cast<double>(sizes.size());
    const double variance = n * (n + 1) * (2 * n + 1) / 24 - ranks.ties / 48;
    result.p = normal_p(result.statistic - n * (n + 1) / 4, variance);
    return result;
  }
  // In how many ways signs give each sum.
  std::vector<double> counts(most + 1, 0.0);
  counts[0] = 1;
  for (const std::size_t rank : ranks.doubled) {
    for (std::size_t s = most; s >= rank; --s) counts[s] += counts[s - rank];
  }
  result.p = two_sided(counts, sum);
  return result;
}

TestResult mann_whitney(std::span<const double> a, std::span<const double> b) {
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  const Ranks ranks = ranks_of(all);
  const auto first = ranks.doubled.begin();
  const std::size_t sum =
      std::accumulate(first, first + static_cast<std::ptrdiff_t>(a.size()), std::size_t{0});
  const auto m = static_cast<double>(a.size());
  const auto n = static_cast<double>(b.size());
  TestResult result{static_cast<double>(sum) / 2 - m * (m + 1) / 2, 1, all.size() <= kMostExact};
  if (a.empty() || b.empty()) return result;
  if (!result.exact) {
    const double size = m + n;
    const double variance = m * n / 12 * (size + 1 - ranks.ties / (size * (size - 1)));
    result.p = normal_p(result.statistic - m * n / 2, variance);
    return result;
  }
  // In how many ways a choice of a.size() values gives each sum of ranks.
  const std::size_t most = std::accumulate(first, ranks.doubled.end(), std::size_t{0});
  std::vector<std::vector<double>> counts(a.size() + 1, std::vector<double>(most + 1, 0.0));
  counts[0][0] = 1;
  for (const std::size_t rank : ranks.doubled) {
    for (std::size_t k = a.size(); k > 0; --k) {
      for (std::size_t s = most; s >= rank; --s) counts[k][s] += counts[k - 1][s - rank];
    }
  }
  result.p = two_sided(counts[a.size()], sum);
  return result;
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double largest = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double one = std::min(1.0, static_cast<double>(order.size() - i) * p[order[i]]);
    largest = std::max(largest, one);
    corrected[order[i]] = largest;
  }
  return corrected;
}

}  // namespace rave::statistics
