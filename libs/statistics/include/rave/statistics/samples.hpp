// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

namespace rave::statistics {

/// An estimate and its interval.
struct Interval {
  double estimate = 0;
  double low = 0;
  double high = 0;
};

enum class Centre : std::uint8_t { kMean, kMedian };

/// Precondition of all: at least one value, none of them NaN.
[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double median(std::span<const double> values);
/// Linear between the order statistics (type 7 of Hyndman and Fan, The American Statistician 50,
/// 1996). `share`: 0 to 1.
[[nodiscard]] double quantile(std::span<const double> values, double share);
/// With n - 1; 0 for one value.
[[nodiscard]] double standard_deviation(std::span<const double> values);

/// The percentile bootstrap interval of mean or median (Efron, Annals of Statistics 7, 1979), with
/// 2000 draws that depend on `seed` alone. `level`: such as 0.95.
[[nodiscard]] Interval bootstrap(std::span<const double> values, Centre centre, double level = 0.95,
                                 std::uint64_t seed = 1);

}  // namespace rave::statistics
