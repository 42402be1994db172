// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/experiment/ledger.hpp"
#include "rave/experiment/plan.hpp"

namespace rave::experiment {

/// How a run is started.
struct RunProcessOptions {
  std::filesystem::path program;       ///< The executable `rave`.
  std::vector<std::string> arguments;  ///< More words of `rave run`, as `--plugins` and its value.
  std::filesystem::path folder;        ///< Its results; replaced, and left in place.
  bool record = false;
  /// Asked several times a second; true ends the run. May be empty.
  std::function<bool()> stop;
};

/// Does one run of a plan in a process of its own, which ends with the thread that calls. A run
/// that crashes, takes longer than its limit or does not complete gives a row with its reason.
/// Empty: ended by `stop`. Errors: kNotFound, kIo (it cannot be started), and those of value_of()
/// for a metric that the results do not have.
[[nodiscard]] Result<std::optional<RunRow>> run_process(const Plan& plan, const PlannedRun& run,
                                                        const RunProcessOptions& options);

}  // namespace rave::experiment
