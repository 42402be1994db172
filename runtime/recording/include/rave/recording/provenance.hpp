// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/record/run_info.hpp"
#include "rave/sim/engine.hpp"

// The inputs of a run besides its scenario, so that others can check whether they have the same.
namespace rave::runtime {

/// SHA-256 of a file's content as 64 hexadecimal digits. Errors: kNotFound, kIo.
[[nodiscard]] Result<std::string> sha256_of_file(const std::filesystem::path& path);

/// The same of bytes in memory.
[[nodiscard]] std::string sha256_of(std::string_view bytes);

/// Adds the maps of the scenario and their images to the inputs of the run, with their content, as
/// it was read for the scenario.
void add_maps(const config::ExpandedScenario& scenario, record::RunInfo& info);

/// Adds the recordings that sensors name in their reports (`log`, or `folder` and `file`) to the
/// inputs. The content of small ones goes with them, so that the recording is enough to repeat the
/// run. Unreadable files are omitted, because they did not prevent the start.
void add_played_files(const sim::Engine& engine, record::RunInfo& info);

/// The versions of RAVE and of each driver and program used in this process: `rave`, `driver NAME`,
/// `program NAME`.
[[nodiscard]] std::map<std::string, std::string> versions_of(const sim::EngineSpec& spec,
                                                             plugin::Catalogue& catalogue);

}  // namespace rave::runtime
