// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/error.hpp"
#include "rave/config/experiment_file.hpp"

namespace rave::experiment {

/// One combination of values of the factors.
struct Condition {
  std::vector<std::string> levels;  ///< The value of each factor, as people read it.
  /// `KEY=VALUE` for config::Settings: those of all runs, then those of the factors.
  std::vector<std::string> settings;
  /// Where each setting is written in the experiment file; as many as settings.
  std::vector<SourceLocation> places;
};

/// The conditions of an experiment, in the order of its design. Those of a Latin hypercube depend
/// on `first_seed` alone. Source of the sampling: McKay, Beckman, Conover, "A comparison of three
/// methods for selecting values of input variables", Technometrics 21 (1979).
[[nodiscard]] std::vector<Condition> conditions_of(const config::ExperimentFile& experiment);

/// `speed=0.3, size=1`: a condition in words.
[[nodiscard]] std::string condition_text(const config::ExperimentFile& experiment,
                                         const Condition& condition);

}  // namespace rave::experiment
