// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/base/error.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::cli {

/// Everything that keeps a scenario from being built. Building stops at the first error, so the
/// part that is wrong is taken out and the rest tried again, until it builds or nothing can be
/// taken out. Errors that only follow from what was taken out are left out. `scenario` is consumed.
[[nodiscard]] std::vector<Error> build_errors(config::ExpandedScenario scenario,
                                              plugin::Catalogue& catalogue,
                                              const runtime::BuildOptions& options);

}  // namespace rave::cli
