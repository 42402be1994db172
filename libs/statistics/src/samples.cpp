// SPDX-License-Identifier: Apache-2.0
#include "rave/statistics/samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "rave/base/random.hpp"

namespace rave::statistics {
namespace {

constexpr std::size_t kDraws = 2000;

double sorted_quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::span<const double> values, double share) {
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted_quantile(sorted, share);
}

double median(std::span<const double> values) { return quantile(values, 0.5); }

double standard_deviation(std::span<const double> values) {
  if (values.size() < 2) return 0;
  const double centre = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

Interval bootstrap(std::span<const double> values, Centre centre, double level,
                   std::uint64_t seed) {
  const auto of = [centre](std::span<const double> sample) {
    return centre == Centre::kMean ? mean(sample) : median(sample);
  };
  RandomStream random(seed, 0, 0, 0);
  std::vector<double> sample(values.size());
  std::vector<double> drawn(kDraws);
  for (double& estimate : drawn) {
    for (double& value : sample) {
      const auto at =
          static_cast<std::size_t>(random.uniform() * static_cast<double>(values.size()));
      value = values[std::min(at, values.size() - 1)];
    }
    estimate = of(sample);
  }
  std::ranges::sort(drawn);
  return {of(values), sorted_quantile(drawn, (1 - level) / 2),
          sorted_quantile(drawn, (1 + level) / 2)};
}

}  // namespace rave::statistics
