// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"

// A run of several processes leaves one recording per process. These functions merge them into the
// recording of the whole run.
namespace rave::record {

/// The file that a path of a run refers to.
struct OpenedRun {
  std::filesystem::path file;
  std::vector<std::string> notes;  ///< Problems with its completeness, one sentence each.
};

/// Finds the recording of a run. `path` is a file or the folder of a run. In a folder it is
/// `run.mcap`. If several processes ran it (`hosts/*/run.mcap`, `world.mcap`), their recordings are
/// merged into `run.mcap`, which is kept until one of them changes. Missing or truncated parts are
/// listed in the notes and left out. A single file is not checked for existence. Errors: kIo,
/// kParse (recordings of different runs, or damaged at the beginning).
[[nodiscard]] Result<OpenedRun> open_run(const std::filesystem::path& path);

/// Merges several recordings into one. For each time it contains the streams of all in the given
/// order; poses by robot, from the host that runs it; and once what several contain (console lines,
/// inputs, events of the world). The hash of a step is the sum of their hashes. `output` is
/// replaced atomically. Returns the notes of OpenedRun. Errors: those of open_run().
[[nodiscard]] Result<std::vector<std::string>> merge_records(
    const std::vector<std::filesystem::path>& parts, const std::filesystem::path& output);

/// The host that wrote this recording; empty: the only one, or it is merged.
[[nodiscard]] std::string host_of(const McapReader& reader);
/// Whether a recording was merged from several.
[[nodiscard]] bool is_merged(const McapReader& reader);
/// The files that were merged, relative to the folder of the recording, with their sizes at that
/// time; empty: not merged.
[[nodiscard]] StringMap merged_files(const McapReader& reader);
/// The missing or truncated parts of a merged recording; empty: none, or it is not merged.
[[nodiscard]] std::vector<std::string> missing_parts(const McapReader& reader);

}  // namespace rave::record
