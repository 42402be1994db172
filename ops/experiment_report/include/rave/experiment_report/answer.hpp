// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/experiment_report/analysis.hpp"

namespace rave::experiment {

/// A number for people: three significant digits, without an exponent.
[[nodiscard]] std::string number_text(double value);
/// `< 0.001`, `0.034`
[[nodiscard]] std::string p_text(double p);
/// `capture_time, s`
[[nodiscard]] std::string metric_title(const config::MetricFile& metric);
/// The centre of a metric in a condition: `15.4`, or of a time `17.2`, `not by half of the runs`.
[[nodiscard]] std::string centre_text(const MetricSummary& summary, bool timed);
/// `0.9 to 2.3`, or `7 of 20` runs that saw the event; empty: unknown.
[[nodiscard]] std::string spread_text(const MetricSummary& summary, bool timed);

/// What a comparison shows, in a sentence.
[[nodiscard]] std::string sentence(const Analysis& analysis, const ComparisonAnalysis& comparison);
/// What the experiment shows, in a sentence: its first comparison, or the best condition.
[[nodiscard]] std::string answer(const Analysis& analysis);

}  // namespace rave::experiment
