// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "commands/run.hpp"
#include "console.hpp"
#include "rave/host/run.hpp"

namespace rave::cli {

/// Prints how a run ended, also what is missing in the file of the console; the exit code of the
/// run.
[[nodiscard]] int report_outcome(const RunCommand& options, runtime::RunOutcome outcome,
                                 const std::filesystem::path& folder, Console& console);

}  // namespace rave::cli
