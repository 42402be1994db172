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

/// A `FLASER` row: what the front laser saw, and where it was.
struct ScanRow {
  int line = 0;                           ///< From 1.
  std::int64_t stamp_ns = 0;              ///< `ipc_timestamp`, absolute.
  std::optional<std::int64_t> logged_ns;  ///< `logger_timestamp`; none: it is no time.
  Pose2 X_WL;                             ///< Of the laser, as logged; heading not wrapped.
  Pose2 X_WO;             ///< Of the robot in the odometry's frame; equal in a corrected log.
  std::size_t first = 0;  ///< Of ParsedLog::ranges_m; `beams` of them.
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
  std::vector<ScanRow> scans;  ///< In the order of the file, as is all else.
  std::vector<float> ranges_m;
  std::uint32_t beams = 0;  ///< Of every scan.
  std::vector<OdometryRow> odometry;
  std::vector<recording::Repair> scan_repairs;
  std::vector<recording::Repair> odometry_repairs;
  /// Rows of messages that are part of the format and not used here.
  std::int64_t passed_over = 0;

  [[nodiscard]] std::span<const float> ranges(const ScanRow& scan) const {
    return std::span(ranges_m).subspan(scan.first, beams);
  }
};

/// Reads a CARMEN log: one message a line, `NAME content… ipc_timestamp ipc_hostname
/// logger_timestamp`; `#` starts a comment line. Source of the format: the header that the logger
/// writes, http://carmen.sourceforge.net/logger_playback.html. Of the messages, FLASER and ODOM are
/// read; the others that exist are passed over and counted. Metres, radians, m/s, rad/s.
///
/// Logs that a mapping program corrected hold, behind each FLASER, an ODOM row whose stamp was
/// never filled in (0, or any bit pattern). An ODOM row right behind a FLASER whose stamp is no
/// time or is more than a second before that scan is dropped and reported as `junk_stamp`.
///
/// A last line without newline, and whatever a broken gzip stream ended with, counts as cut: it is
/// an error, or with `accept_cut` left out and reported.
/// Errors (kParse, with `file`, line, column): an unknown message, with the nearest name; a wrong
/// number of words; a value that is not what its place holds (ranges: 0 to 1000 m; others within
/// +-1e6; stamps: seconds with at most nine decimals); scans of different numbers of beams.
[[nodiscard]] Result<ParsedLog> parse_log(const recording::UnpackedText& log,
                                          const std::string& file, bool accept_cut);

}  // namespace rave::carmen
