// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace rave::statistics {

/// The result of a test of two sides.
struct TestResult {
  double statistic = 0;
  double p = 1;        ///< The probability of a result at least as extreme without a difference.
  bool exact = false;  ///< By counting; otherwise by the normal or chi-squared distribution.
};

/// Wilcoxon's signed-rank test of paired differences (Biometrics Bulletin 1, 1945); zeros are left
/// out. The statistic is the sum of the ranks of positive differences. Exact, with ties, up to 50
/// differences; beyond that normal, with corrections for ties and continuity.
[[nodiscard]] TestResult wilcoxon(std::span<const double> differences);

/// The test of Mann and Whitney (Annals of Mathematical Statistics 18, 1947) of two independent
/// samples. The statistic is U of `a`: pairs in which its value is larger, equal ones by half.
/// Exact, with ties, up to 50 values in all; beyond that normal, with both corrections.
[[nodiscard]] TestResult mann_whitney(std::span<const double> a, std::span<const double> b);

/// Probabilities corrected for their number (Holm, Scandinavian Journal of Statistics 6, 1979), in
/// the order given.
[[nodiscard]] std::vector<double> holm(std::span<const double> p);

}  // namespace rave::statistics
