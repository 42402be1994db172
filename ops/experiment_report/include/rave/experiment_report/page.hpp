// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/experiment_report/analysis.hpp"

namespace rave::experiment {

/// The report of an experiment as one HTML page that asks for nothing else: no font, no script, no
/// picture. `version`: that of RAVE. The same analysis gives the same bytes.
[[nodiscard]] std::string report_page(const Analysis& analysis, const std::string& version);

}  // namespace rave::experiment
