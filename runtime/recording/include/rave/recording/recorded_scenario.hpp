// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_info.hpp"

namespace rave::runtime {

/// The scenario of a recorded run, with the maps that the run had.
struct RecordedScenario {
  config::ExpandedScenario scenario;
  std::set<std::string> inside;  ///< Paths of the inputs that the recording itself has.
  /// One sentence for each map that is another one outside of the recording by now, or that only
  /// is outside and has changed.
  std::vector<std::string> notes;
};

/// Reads it. Maps that the recording has are not looked for outside; a recording of an earlier
/// version has none, so its maps are read from where they were. Errors: kParse (a tool that copied
/// the recording left the scenario out; or a scenario of another version), and those of a map that
/// is neither inside nor outside.
[[nodiscard]] Result<RecordedScenario> recorded_scenario(const record::McapReader& reader,
                                                         const record::RunInfo& run,
                                                         const std::filesystem::path& record);

}  // namespace rave::runtime
