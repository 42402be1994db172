// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/error.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::cli {

/// All errors that prevent a scenario from being built. Building stops at the first error, so the
/// wrong part is removed and the rest is built again, until it builds or nothing can be removed.
/// Errors that only follow from a removal are omitted. `scenario` is consumed.
[[nodiscard]] std::vector<Error> build_errors(config::ExpandedScenario scenario,
                                              plugin::Catalogue& catalogue,
                                              const runtime::BuildOptions& options);

}  // namespace rave::cli
