// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "scip_laser/scip_session.hpp"

namespace rave::scip {

/// The state of the driver's thread for the report. A plain value.
struct LaserState {
  bool connected = false;
  std::uint64_t connects = 0;      ///< Number of times that scans began, the first included.
  std::uint64_t scans = 0;         ///< Scans delivered.
  std::uint64_t bad_checksum = 0;  ///< Replies dropped: wrong checksum.
  std::uint64_t malformed = 0;     ///< Replies dropped: wrong format.
  std::uint64_t repeated = 0;      ///< Scans dropped: not later than the previous one.
  std::uint64_t early = 0;         ///< Scans dropped: they seemed to arrive before they were sent.
  /// Scans dropped: a better clock estimate moved them before the previous one.
  std::uint64_t held_back = 0;
  std::uint64_t blind = 0;    ///< Scans dropped: every ray is an error code.
  std::uint64_t refused = 0;  ///< Replies with an error status.
  double clock_offset_s = 0;  ///< Host (its steady clock) minus device, smallest delay included.
  double clock_drift_ppm = 0;
  std::uint64_t clock_restarts = 0;
  double rate_hz = 0;   ///< Since the last connect.
  std::string trouble;  ///< The last problem; empty if there was none.
};

/// One JSON object.
[[nodiscard]] std::string report_json(const std::string& where, const Identity& identity,
                                      const ScanRequest& request, const LaserState& state);

}  // namespace rave::scip
