// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "scip_laser/scip_session.hpp"

namespace rave::scip {

/// What the driver's thread has seen, for the report. A plain value.
struct LaserState {
  bool connected = false;
  std::uint64_t connects = 0;      ///< Times that scans began, the first included.
  std::uint64_t scans = 0;         ///< Handed over.
  std::uint64_t bad_checksum = 0;  ///< Replies dropped.
  std::uint64_t malformed = 0;     ///< Replies dropped.
  std::uint64_t repeated = 0;      ///< Scans dropped: not after the one before.
  std::uint64_t held_back = 0;     ///< Scans dropped: a better clock estimate put them too early.
  std::uint64_t refused = 0;       ///< Replies with an error status.
  double clock_offset_s = 0;  ///< Host (its steady clock) minus device, smallest delay included.
  double clock_drift_ppm = 0;
  std::uint64_t clock_restarts = 0;
  double rate_hz = 0;   ///< Over all scans since the last connect.
  std::string trouble;  ///< The last one; empty if there was none.
};

/// One JSON object.
[[nodiscard]] std::string report_json(const std::string& where, const Identity& identity,
                                      const ScanRequest& request, const LaserState& state);

}  // namespace rave::scip
