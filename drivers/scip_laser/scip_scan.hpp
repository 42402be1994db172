// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scip_laser/error_codes.hpp"
#include "scip_laser/scip_decoder.hpp"

namespace rave::scip {

/// The requested part of a scan, and its encoding.
struct ScanRequest {
  bool continuous = true;       ///< MD or MS; otherwise GD or GS, one command per scan.
  std::int32_t characters = 3;  ///< Of one range: 3 (up to 262 m) or 2 (up to 4.094 m).
  std::int32_t first_step = 0;
  std::int32_t last_step = 0;
  /// Scans skipped between two that are sent, 0 to 9. Continuous mode only.
  std::int32_t skipped_scans = 0;
  std::int32_t range_min_mm = 0;
  std::int32_t range_max_mm = 0;
  ErrorCodes codes = ErrorCodes::kDistances;

  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(last_step - first_step + 1);
  }
  /// The command without newline, as the device echoes it.
  [[nodiscard]] std::string command() const;
};

struct Scan {
  std::uint32_t timer_ms = 0;  ///< The device's 24-bit timer when the scan passed step 0.
  /// Metres, by step. +infinity without return: above the maximum, the largest encodable number, or
  /// an error code that says so. NaN: another error code.
  std::vector<float> ranges_m;

  /// Whether any step was measured.
  [[nodiscard]] bool sees() const noexcept;
};

enum class ScanEnd {
  kScan,      ///< `scan` is set.
  kNoScan,    ///< Another reply: confirmation of the command, or an unrelated one.
  kRefused,   ///< The device refused the command or stopped; see the status.
  kMalformed  ///< The status of a scan, but missing or surplus data.
};

/// Decodes a scan from a reply. The number and lengths of lines must match the request exactly.
[[nodiscard]] ScanEnd read_scan(const Reply& reply, const ScanRequest& request, Scan& scan);

/// The meaning of a status of MD, MS, GD, GS or BM in words.
[[nodiscard]] std::string describe_status(std::string_view status);

}  // namespace rave::scip
