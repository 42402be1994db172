// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine.hpp"

// The inputs of a run besides its scenario, so that others can check whether they have the same.
namespace rave::runtime {

/// SHA-256 of a file's content as 64 hexadecimal digits. Errors: kNotFound, kIo.
[[nodiscard]] Result<std::string> sha256_of_file(const std::filesystem::path& path);

/// Files that a run reads in addition to its expanded scenario: maps with their images, and the
/// recordings that sensors name in their reports (`folder` and `file`). Absolute path to SHA-256.
/// Unreadable files are omitted, because they did not prevent the start.
[[nodiscard]] std::map<std::string, std::string> input_files(
    const config::ExpandedScenario& scenario, const sim::Engine& engine);

/// The versions of RAVE and of each driver and program used in this process: `rave`, `driver NAME`,
/// `program NAME`.
[[nodiscard]] std::map<std::string, std::string> versions_of(const sim::EngineSpec& spec,
                                                             plugin::Catalogue& catalogue);

}  // namespace rave::runtime
