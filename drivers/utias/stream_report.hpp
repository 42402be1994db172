// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "recording/stream_report.hpp"
#include "utias/recording_names.hpp"

namespace rave::utias {

enum class StreamKind : std::uint8_t { kPoses, kOdometry, kSightings };

struct UnknownCode {
  int code = 0;
  std::int64_t count = 0;
};

/// The content of one stream of one robot.
struct StreamReport : recording::StreamReport {
  int robot = 0;
  StreamKind kind = StreamKind::kPoses;
  /// Sightings only: codes without a subject, by code. Their rows are kept.
  std::vector<UnknownCode> unknown_codes;
};

}  // namespace rave::utias
