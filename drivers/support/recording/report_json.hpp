// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "recording/stream_report.hpp"

namespace rave::recording {

/// The requested window in nanoseconds from the origin of the recording, and the offset added to
/// the stamps.
struct Window {
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  double clock_offset_s = 0;
};

/// Appends `file`, `sha256`, `unchanged` and `beside`.
void add_file(nlohmann::ordered_json& json, const StreamReport& report);
/// Appends `start_s`, `end_s`, `clock_offset_s`, `first_stamp_s`, `last_stamp_s`, `rows`, `stamps`,
/// `rate_hz`, `gap_limit_s`, `gaps`, `largest_age_s`, `repairs` and `dropped`; README.md describes
/// them.
void add_timing(nlohmann::ordered_json& json, const StreamReport& report, const Window& window);
/// The JSON in one line of valid UTF-8, even if file names are not UTF-8.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& json);

}  // namespace rave::recording
