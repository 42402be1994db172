// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "rave/experiment/ledger.hpp"
#include "rave/experiment/plan.hpp"
#include "rave/statistics/samples.hpp"
#include "rave/statistics/survival.hpp"

namespace rave::experiment {

/// One metric in one condition.
struct MetricSummary {
  std::size_t condition = 0;   ///< Index in the plan.
  std::vector<double> values;  ///< Of whole runs; of a time to an event those that were seen.
  /// The mean with its interval. Of a time to an event the median time, without an interval.
  std::optional<statistics::Interval> centre;
  std::vector<statistics::TimedEvent> times;  ///< Of a time to an event: all whole runs.
  std::size_t unknown = 0;                    ///< Whole runs without a value; not of times.
};

/// A metric in all conditions.
struct MetricAnalysis {
  std::size_t metric = 0;                ///< Index in the experiment.
  std::vector<MetricSummary> summaries;  ///< In the order of the conditions.
  std::vector<std::size_t> ranking;      ///< Conditions, best first; as they are without an aim.
};

/// What kind of test a comparison had.
enum class ComparisonTest : std::uint8_t { kWilcoxon, kMannWhitney, kLogRank };

/// Two conditions in one metric.
struct ComparisonAnalysis {
  std::size_t metric = 0;
  std::size_t condition = 0;
  std::size_t against = 0;
  ComparisonTest test = ComparisonTest::kWilcoxon;
  std::vector<double> differences;  ///< Seed by seed; paired comparisons only.
  /// Mean difference with its interval; unpaired: of the means, without an interval. Not of times.
  std::optional<statistics::Interval> difference;
  std::optional<double> effect;  ///< Mean over standard deviation of the differences.
  double p = 1;
  double corrected = 1;  ///< p, corrected by Holm for all comparisons of the experiment.
  config::ComparisonOutcome outcome = config::ComparisonOutcome::kNoDifference;
  std::optional<config::ComparisonOutcome> expected;

  [[nodiscard]] bool as_expected() const { return !expected || *expected == outcome; }
};

/// A run without values.
struct FailedRun {
  PlannedRun run;
  std::string reason;
};

/// The numbers of an experiment. A value.
struct Analysis {
  Plan plan;
  std::size_t runs = 0;  ///< Finished, with failed ones.
  std::size_t planned = 0;
  std::vector<MetricAnalysis> metrics;
  std::vector<ComparisonAnalysis> comparisons;  ///< Those that the file names.
  std::vector<FailedRun> failed;
  std::string digest;  ///< Of the hashes of all runs, 16 hexadecimal digits.

  /// Whether all comparisons came out as the file expects; true if it expects nothing.
  [[nodiscard]] bool as_expected() const;
};

/// A difference counts as shown below this corrected probability.
inline constexpr double kSignificance = 0.05;

/// Analyses the finished runs of a plan. Errors: kNotFound (no run is finished), kInvalidArgument
/// (a comparison of conditions that the design does not have).
[[nodiscard]] Result<Analysis> analyse(Plan plan, const RunRows& rows);

/// `less`, `more` or `no difference shown`.
[[nodiscard]] const char* text_of(config::ComparisonOutcome outcome);

}  // namespace rave::experiment
