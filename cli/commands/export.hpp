// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave export`.
struct ExportCommand {
  std::string file;    ///< A recording, or the folder of a run.
  std::string what;    ///< `poses`, `readings` or `events`.
  std::string robot;   ///< Readings: of this robot. Poses and events: empty is all.
  std::string sensor;  ///< Readings: of this sensor.
  std::string output;  ///< Empty: standard output.
};

/// Writes a part of a recording as CSV (RFC 4180, UTF-8, a header line, SI units). Numbers have as
/// many digits as it takes to read the same bits back. Returns 0; 2 for bad input, a recording that
/// is damaged, or an output that cannot be written.
[[nodiscard]] Result<int> export_recording(const ExportCommand& options);

}  // namespace rave::cli
