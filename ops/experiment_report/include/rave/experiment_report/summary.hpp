// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "rave/experiment_report/analysis.hpp"

namespace rave::experiment {

/// The question, the answer, and tables of the metrics and comparisons, for a terminal. `width`:
/// its columns; empty: no limit.
[[nodiscard]] std::string report_summary(const Analysis& analysis, std::optional<std::size_t> width,
                                         bool colours);

/// Metrics by condition as CSV: one row for each, with runs, centre and interval.
[[nodiscard]] std::string condition_table(const Analysis& analysis);

}  // namespace rave::experiment
