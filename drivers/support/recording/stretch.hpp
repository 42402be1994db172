// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::recording {

/// What `stretch.txt` says of a stretch cut by tools/cut_utias.py.
struct Stretch {
  /// Absolute stamp (Unix time) of the whole data set's earliest row.
  std::int64_t origin_ns = 0;
  /// Counted from the origin. The files hold a margin beyond both.
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  /// SHA-256 by file name.
  std::map<std::string, std::string, std::less<>> sha256;
};

/// Reads lines `origin_s: …`, `start_s: …`, `end_s: …` and `sha256: <64 digits> <file name>`;
/// `#` starts a comment line. Errors (kParse, with file:line): any other line, a key given twice
/// or missing, a time that is no number of seconds, start not before end.
[[nodiscard]] Result<Stretch> parse_stretch(std::string_view text, const std::string& file);

}  // namespace rave::recording
