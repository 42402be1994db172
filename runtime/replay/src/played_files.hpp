// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/result.hpp"
#include "rave/record/run_info.hpp"
#include "rave/recording/recorded_scenario.hpp"

namespace rave::runtime {

/// Writes the logs of the recording that are gone or changed outside into this folder, and has the
/// sensors of the scenario play them from there. Errors: kIo.
Status put_played_files(const record::RunInfo& run, const std::filesystem::path& folder,
                        RecordedScenario& recorded);

}  // namespace rave::runtime
