// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/results/outcome.hpp"

namespace rave::runtime {

/// One sentence for each sensor of which more than 5 % of the readings were not played or not used
/// by the driver. Computed from `dropped` in the driver's report: {"count", "of", "because"};
/// sensors without it are skipped. Behind them the `notes` of the reports, an array of sentences;
/// each of a robot once.
[[nodiscard]] std::vector<std::string> stream_losses(const RunResults& results);

}  // namespace rave::runtime
