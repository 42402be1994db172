// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "recording/stream_report.hpp"
#include "recording/unpack.hpp"

namespace rave::carmen {

/// A `FLASER` row: the scan of the front laser and its pose.
struct ScanRow {
  int line = 0;                           ///< From 1.
  std::int64_t stamp_ns = 0;              ///< `ipc_timestamp`, absolute.
  std::optional<std::int64_t> logged_ns;  ///< `logger_timestamp`; empty: not a time.
  Pose2 X_WL;                             ///< Pose of the laser as logged; heading not wrapped.
  std::size_t first = 0;  ///< Index into ParsedLog::ranges_m, which has `beams` of them.
};

/// An `ODOM` row.
struct OdometryRow {
  int line = 0;
  std::int64_t stamp_ns = 0;
  std::optional<std::int64_t> logged_ns;
  Pose2 X_WR;
  double v_mps = 0;
  double w_radps = 0;
};

struct ParsedLog {
  std::vector<ScanRow> scans;  ///< In file order, like all other lists.
  std::vector<float> ranges_m;
  std::uint32_t beams = 0;  ///< Number of beams of every scan.
  std::vector<OdometryRow> odometry;
  std::vector<recording::Repair> scan_repairs;
  std::vector<recording::Repair> odometry_repairs;
  /// Number of rows with valid messages that are not used.
  std::int64_t passed_over = 0;

  [[nodiscard]] std::span<const float> ranges(const ScanRow& scan) const {
    return std::span(ranges_m).subspan(scan.first, beams);
  }
};

/// Reads a CARMEN log: one message per line, `NAME content… ipc_timestamp ipc_hostname
/// logger_timestamp`; `#` starts a comment line. Source of the format: the header that the logger
/// writes, http://carmen.sourceforge.net/logger_playback.html. FLASER and ODOM are read; other
/// known messages are skipped and counted. Metres, radians, m/s, rad/s.
///
/// In logs corrected by a mapping program, an ODOM row with an uninitialised stamp (0, or any bit
/// pattern) follows each FLASER. So an ODOM row right after a FLASER is dropped and reported as
/// `junk_stamp` if its stamp is not a time or is more than a second before that scan.
///
/// A last line without newline counts as truncated, and so does the last line of a broken gzip
/// stream. It is an error, or with `accept_cut` omitted and reported. Errors (kParse, with `file`,
/// line, column): an unknown message, with the nearest name; a wrong number of words; an invalid
/// value (ranges: 0 to 1000 m; others within +-1e6; stamps: seconds with at most nine decimals);
/// scans with different numbers of beams.
[[nodiscard]] Result<ParsedLog> parse_log(const recording::UnpackedText& log,
                                          const std::string& file, bool accept_cut);

}  // namespace rave::carmen
