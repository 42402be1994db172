// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "carmen/messages.hpp"
#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "recording/stream_report.hpp"
#include "recording/unpack.hpp"

namespace rave::carmen {

/// The two clocks of a row; empty: the word is not a time.
struct RowStamps {
  std::optional<std::int64_t> message_ns;  ///< `ipc_timestamp`, absolute.
  std::optional<std::int64_t> logger_ns;   ///< `logger_timestamp`.
};

/// A scan of one laser, and its pose.
struct ScanRow {
  int line = 0;               ///< From 1.
  std::int64_t stamp_ns = 0;  ///< What set_stamps() chose.
  RowStamps stamps;
  const ScanMessage* message = nullptr;  ///< One of kScanMessages.
  std::optional<Pose2> X_WL;             ///< Pose of the laser as logged; heading not wrapped.
  std::size_t first = 0;                 ///< Index into ParsedLog::ranges_m.
  std::uint32_t beams = 0;
  // Of the newer messages; 0: not said.
  double start_rad = 0;
  double step_rad = 0;
  double maximum_m = 0;
};

/// An `ODOM` row.
struct OdometryRow {
  int line = 0;
  std::int64_t stamp_ns = 0;
  RowStamps stamps;
  Pose2 X_WR;
  double v_mps = 0;
  double w_radps = 0;
};

/// The rows of a kind that are not used.
struct PassedOver {
  std::string name;
  std::int64_t count = 0;
  bool known = false;  ///< The format has this message.
};

struct ParsedLog {
  std::vector<ScanRow> scans;  ///< In file order, like all other lists.
  /// Metres; NaN where the log has NaN or a negative number.
  std::vector<float> ranges_m;
  std::vector<OdometryRow> odometry;
  std::vector<recording::Repair> scan_repairs;
  std::vector<recording::Repair> odometry_repairs;
  std::vector<PassedOver> passed_over;  ///< In the order of their first rows.
  /// The errors of the first rows that are refused, with file:line:column.
  std::vector<std::string> refusals;
  /// Of the messages, rows have stamps of several clocks (set_stamps()).
  bool mixed_clocks = false;
  /// From the centre of the robot to the laser, along the robot's x axis.
  double laser_offset_m = 0;

  [[nodiscard]] std::span<const float> ranges(const ScanRow& scan) const {
    return std::span(ranges_m).subspan(scan.first, scan.beams);
  }
  void pass_over(std::string_view name, bool known);
  void refuse(std::vector<recording::Repair>& repairs, int line, std::string why);
};

/// Reads a CARMEN log: one message per line, `NAME content… ipc_timestamp ipc_hostname
/// logger_timestamp`; `#` starts a comment line. Source of the format: the header that the logger
/// writes, http://carmen.sourceforge.net/logger_playback.html. Read are the scans of one laser
/// (messages.hpp), ODOM, and the PARAM with the place of the laser; other messages are passed over
/// and counted by name, unknown ones too. Metres, radians, m/s, rad/s.
///
/// In logs corrected by a mapping program, an ODOM row with an uninitialised stamp (0, or any bit
/// pattern) follows each scan. So an ODOM row right after a scan is dropped and reported as
/// `junk_stamp` if its stamp is not a time or is more than a second before that scan.
///
/// A row with a wrong number of words or an invalid value is refused by itself and reported as
/// `refused_row`. Ranges may be any number; others are within +-1e6, angles within +-1e4. A last
/// line without newline counts as truncated, and so does the last line of a broken gzip stream.
/// That is an error (kParse, with `file`, line, column), or with `accept_cut` omitted and reported.
[[nodiscard]] Result<ParsedLog> parse_log(const recording::UnpackedText& log,
                                          const std::string& file, bool accept_cut,
                                          LaserSide side = LaserSide::kFront);

}  // namespace rave::carmen
