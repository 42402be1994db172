// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/experiment_report/analysis.hpp"

// The plots of the page, as SVG for its inside.
namespace rave::experiment {

/// One row per condition, best first: dot, interval and the values of the runs.
[[nodiscard]] std::string interval_plot(const Analysis& analysis, const MetricAnalysis& metric);

/// One row per comparison with pairs: difference, interval and the pairs. Empty: none has any.
[[nodiscard]] std::string difference_plot(const Analysis& analysis, std::size_t metric);

/// Kaplan-Meier curves of a time to an event, of at most six conditions, spread over the ranking.
[[nodiscard]] std::string survival_plot(const Analysis& analysis, const MetricAnalysis& metric);

/// The centres of a metric over two factors. Empty: the design is not two crossed factors.
[[nodiscard]] std::string heat_map(const Analysis& analysis, const MetricAnalysis& metric);

/// A curve with its band over the only factor, which has numbers. Empty: it is not so.
[[nodiscard]] std::string curve(const Analysis& analysis, const MetricAnalysis& metric);

}  // namespace rave::experiment
