// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scip_laser/scip_decoder.hpp"

namespace rave::scip {

/// Which ranges are asked for, and how.
struct ScanRequest {
  bool continuous = true;       ///< MD or MS; otherwise GD or GS, one command per scan.
  std::int32_t characters = 3;  ///< Of one range: 3 (up to 262 m) or 2 (up to 4.094 m).
  std::int32_t first_step = 0;
  std::int32_t last_step = 0;
  std::int32_t skipped_scans = 0;  ///< Between two that are sent, 0 to 9. Continuous only.
  std::int32_t range_min_mm = 0;   ///< What is less is an error code.
  std::int32_t range_max_mm = 0;

  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(last_step - first_step + 1);
  }
  /// The command without its line end, as the device echoes it.
  [[nodiscard]] std::string command() const;
};

struct Scan {
  std::uint32_t timer_ms = 0;  ///< The device's 24-bit timer when the scan passed step 0.
  /// Metres, by step; +infinity where there is no return: an error code (less than the smallest
  /// range), more than the largest, or the largest number that the characters hold.
  std::vector<float> ranges_m;
};

enum class ScanEnd {
  kScan,      ///< `scan` is filled.
  kNoScan,    ///< A reply of another kind: the acceptance of the command, or a stray one.
  kRefused,   ///< The device refused the command or broke off; see the status.
  kMalformed  ///< A scan by its status, but not all of it, or too much.
};

/// Reads a scan from a reply. A scan is only taken whole: as many lines, of just the lengths, as
/// the request leads to.
[[nodiscard]] ScanEnd read_scan(const Reply& reply, const ScanRequest& request, Scan& scan);

/// What a status of MD, MS, GD, GS or BM says, for people.
[[nodiscard]] std::string describe_status(std::string_view status);

}  // namespace rave::scip
