// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "rave/base/result.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/moment_cursor.hpp"
#include "rave/record/run_reader.hpp"

namespace rave::record {

/// The recording of one process, at one log time.
struct MergePart {
  std::filesystem::path path;
  std::string host;  ///< Empty: the world authority.
  McapReader reader;
  RunInfo info;
  std::optional<RunEnd> end;
  MomentCursor cursor;
  bool more = true;
  bool here = false;   ///< It has messages at the merged time.
  std::string torn{};  ///< Why it is incomplete; empty: it is complete.

  /// To the next time that has messages. An error ends the part: the file is damaged from there on.
  void advance();
};

/// Opens a part before its first message. Errors: kIo, kParse.
[[nodiscard]] Result<std::unique_ptr<MergePart>> open_part(const std::filesystem::path& path);

}  // namespace rave::record
