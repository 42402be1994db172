// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"

// A run of several processes leaves a record each; together they make that of the whole run.
namespace rave::record {

/// What a word for a run stands for: one file.
struct OpenedRun {
  std::filesystem::path file;
  std::vector<std::string> notes;  ///< What is not whole; one sentence each, for people.
};

/// The record of a run. `path` is a file, or the folder of a run: there it is `run.mcap`, or, if
/// several processes ran it (`hosts/*/run.mcap`, `world.mcap`), what is made of their records and
/// then kept as `run.mcap` until one of them changes. What is missing or torn is said in the notes,
/// and it goes on with the rest. Does not say whether a single file is there. Errors: kIo, kParse
/// (the records are of different runs, or damaged at their beginning).
[[nodiscard]] Result<OpenedRun> open_run(const std::filesystem::path& path);

/// Makes one record of several: at each time the streams of all in the order given, poses by robot
/// from the host that runs it, and once what several have (lines of the console, inputs, events of
/// the world). The hash of a step is the sum of theirs. `output` is replaced as a whole. Returns
/// the notes of OpenedRun. Errors: as open_run().
[[nodiscard]] Result<std::vector<std::string>> merge_records(
    const std::vector<std::filesystem::path>& parts, const std::filesystem::path& output);

/// Which host of several left this record; empty: none, or all.
[[nodiscard]] std::string host_of(const McapReader& reader);
/// Whether a record was made of several.
[[nodiscard]] bool is_merged(const McapReader& reader);
/// The files of which a record was made, relative to its folder, and their bytes then; empty: of
/// none.
[[nodiscard]] StringMap merged_files(const McapReader& reader);
/// What is missing or torn of a record that was made of several; empty: nothing, or it was not.
[[nodiscard]] std::vector<std::string> missing_parts(const McapReader& reader);

}  // namespace rave::record
