// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recording/stream_report.hpp"

namespace rave::recording {

/// The window that was asked for, nanoseconds from the origin of the recording, and what was added
/// to the stamps.
struct Window {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  double clock_offset_s = 0;
};

/// Appends `file`, `sha256` and `unchanged`.
void add_file(nlohmann::ordered_json& json, const StreamReport& report);
/// Appends `start_s`, `end_s`, `clock_offset_s`, `first_stamp_s`, `last_stamp_s`, `rows`, `stamps`,
/// `rate_hz`, `gap_limit_s`, `gaps`, `largest_age_s`, `repairs` and `dropped`, described in
/// README.md.
void add_timing(nlohmann::ordered_json& json, const StreamReport& report, const Window& window);
/// One line of UTF-8, whatever bytes a file name brought in.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& json);

}  // namespace rave::recording
