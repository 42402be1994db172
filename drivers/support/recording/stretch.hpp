// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "recording/stream_report.hpp"

namespace rave::recording {

/// The content of the `stretch.txt` of an excerpt made by tools/cut_utias.py.
struct Stretch {
  /// Absolute stamp (Unix time) of the earliest row of the whole data set.
  std::int64_t origin_ns = 0;
  /// From the origin. The files contain a margin at both ends.
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  /// SHA-256 by file name.
  std::map<std::string, std::string, std::less<>> sha256;
};

/// Parses lines `origin_s: …`, `start_s: …`, `end_s: …` and `sha256: <64 digits> <file name>`; `#`
/// starts a comment line. Errors (kParse, with file:line): any other line, a duplicate or missing
/// key, an invalid time, start not before end.
[[nodiscard]] Result<Stretch> parse_stretch(std::string_view text, const std::string& file);

/// Reads the `stretch.txt` of a folder, if it has one. Errors: kIo, those of parse_stretch().
[[nodiscard]] Result<std::optional<Stretch>> read_stretch(const std::filesystem::path& folder);

/// Identifies the log at `path`, whose bytes have been parsed with these repairs. Error kParse: it
/// differs from the one that the stretch lists, and is not one whose truncation was accepted.
[[nodiscard]] Result<LogIdentity> identify(const std::filesystem::path& path,
                                           std::string_view bytes,
                                           const std::vector<Repair>& repairs,
                                           const std::optional<Stretch>& stretch);

}  // namespace rave::recording
