// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/results/outcome.hpp"

namespace rave::runtime {

/// Sensors of which more than 5 % of the readings were not played or used by their driver, one
/// sentence each. From `dropped` in the report of the driver: {"count", "of", "because"}; a report
/// without it says nothing.
[[nodiscard]] std::vector<std::string> stream_losses(const Findings& findings);

}  // namespace rave::runtime
