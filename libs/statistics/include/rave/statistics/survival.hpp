// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "rave/statistics/rank_tests.hpp"

namespace rave::statistics {

/// A time at which an event was seen, or until which it was not (censored).
struct TimedEvent {
  double time = 0;
  bool seen = false;
};

/// A point of a Kaplan-Meier curve.
struct SurvivalStep {
  double time = 0;
  double share = 1;         ///< Estimated share without an event after this time.
  std::size_t at_risk = 0;  ///< Just before this time.
  std::size_t events = 0;
  std::size_t censored = 0;  ///< At this time.
};

/// The estimate of Kaplan and Meier (Journal of the American Statistical Association 53, 1958): one
/// step for each time, in ascending order. Events come before censoring at the same time.
[[nodiscard]] std::vector<SurvivalStep> kaplan_meier(std::span<const TimedEvent> times);

/// The first time at which at most half are without an event; empty: more than half never were.
[[nodiscard]] std::optional<double> median_time(std::span<const SurvivalStep> curve);

/// The log-rank test of two samples (Mantel, Cancer Chemotherapy Reports 50, 1966). The statistic
/// is chi-squared with one degree of freedom, negative if `a` has fewer events than expected.
[[nodiscard]] TestResult log_rank(std::span<const TimedEvent> a, std::span<const TimedEvent> b);

}  // namespace rave::statistics
