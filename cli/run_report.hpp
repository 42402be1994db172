// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "commands/run.hpp"
#include "rave/host/run.hpp"

namespace rave::cli {

/// Tells how a run ended; the exit code of the run.
[[nodiscard]] int report_outcome(const RunCommand& options, const runtime::RunOutcome& outcome,
                                 const std::filesystem::path& folder);

}  // namespace rave::cli
