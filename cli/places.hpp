// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::cli {

/// The folder of the running executable. The build tree has the layout of an installation, so
/// everything else is found from here.
[[nodiscard]] std::filesystem::path executable_folder();

/// Templates and shipped scenarios: RAVE_SHARE, else `../share/rave` beside the executable.
[[nodiscard]] std::filesystem::path share_folder();

/// The names of the scenarios of the share folder, sorted; empty if it has none.
[[nodiscard]] std::vector<std::string> shipped_scenarios();

/// The names that stand for a scenario here: those, and the ones of `scenarios` of the current
/// folder; sorted.
[[nodiscard]] std::vector<std::string> known_scenarios();

/// The experiment file that a word on the command line stands for: like find_scenario(), with
/// `experiment.yaml` and `experiments`.
[[nodiscard]] Result<std::filesystem::path> find_experiment(std::string_view word);

/// The executable for programs with `isolate: true`.
[[nodiscard]] std::filesystem::path program_runner();

/// A catalogue of the folders given on the command line, those of RAVE_PLUGIN_PATH and the built-in
/// one: launch::open_catalogue().
[[nodiscard]] Result<std::unique_ptr<plugin::Catalogue>> open_catalogue(
    const std::vector<std::string>& given);

/// The scenario file that a word on the command line stands for: a file, a folder with
/// `scenario.yaml`, or the name of a scenario below `scenarios` of the current folder or the share
/// folder. Errors: kNotFound with the nearest name or the list.
[[nodiscard]] Result<std::filesystem::path> find_scenario(std::string_view word);

/// The record that a word on the command line stands for: the file itself, or that of the run in a
/// folder (record::open_run()); what is missing of it is printed. Does not say whether a file is
/// there. Errors: those of open_run().
[[nodiscard]] Result<std::filesystem::path> record_file(std::string_view word);

}  // namespace rave::cli
