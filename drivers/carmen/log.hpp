// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "recording/pose_track.hpp"
#include "recording/stream_report.hpp"
#include "recording/unpack.hpp"
#include "recording/window.hpp"

namespace rave::carmen {

/// One scan. Times in nanoseconds from the origin of the log.
struct Scan {
  std::int64_t t_ns = 0;
  Pose2 X_WL;             ///< Pose of the laser in the frame of the log.
  std::size_t first = 0;  ///< Index into Log::ranges_m.
};

/// Wheel odometry. Times in nanoseconds from the origin of the log.
struct OdometrySample {
  std::int64_t t_ns = 0;
  Pose2 X_WR;
  double v_mps = 0;
  double w_radps = 0;
};

struct LoadOptions {
  recording::WindowOptions window;
  double clock_offset_s = 0;  ///< Added to all stamps, within +-1000.
  bool accept_cut = false;
  /// A range this long or longer is "no return", metres.
  double range_max_m = 80;
};

/// A part of a CARMEN log in memory. A plain value. Scans and odometry ascend in time, extend
/// beyond the window by the margin, and include one sample before that.
struct Log {
  std::int64_t origin_ns = 0;  ///< Absolute stamp of time 0.
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  std::uint32_t beams = 0;
  std::vector<Scan> scans;
  /// As logged, metres; values of at least `range_max_m` are +infinity (REP-117).
  std::vector<float> ranges_m;
  std::vector<OdometrySample> odometry;
  recording::StreamReport scan_report;
  recording::StreamReport odometry_report;
  /// Number of ranges without return in the window.
  std::int64_t no_returns = 0;
  /// Number of rows with messages that are not used.
  std::int64_t passed_over = 0;
  /// The stamps are those of the logger, because the message stamps repeat.
  bool by_logger = false;

  [[nodiscard]] std::span<const float> ranges(const Scan& scan) const {
    return std::span(ranges_m).subspan(scan.first, beams);
  }
  /// The poses of the laser.
  [[nodiscard]] recording::PoseTrack track() const;
};

/// Reads a log, plain or gzipped. A `stretch.txt` beside it (tools/cut_carmen.py) gives origin and
/// window; without it the origin is the earliest stamp. Stamps are the `ipc_timestamp`. Exception:
/// in a log without `stretch.txt`, if more than 5 % of the scans share an `ipc_timestamp` and at
/// most 5 % share a `logger_timestamp`, all rows use the latter. Errors: kNotFound, kIo,
/// kInvalidArgument (options), kParse (with file:line:column; a file that differs from the one in
/// `stretch.txt`; a log without scans).
[[nodiscard]] Result<Log> load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Does what load() does, for the text of a log. `file` is used in messages.
[[nodiscard]] Result<Log> load_text(const recording::UnpackedText& text, const std::string& file,
                                    const std::optional<recording::Stretch>& stretch,
                                    const LoadOptions& options);

/// Direction of each ray of a scan in the laser frame, radians, counter-clockwise: evenly spaced
/// over the field and symmetric about the x axis, as in `virtual_laser`.
[[nodiscard]] std::vector<double> bearings_rad(std::uint32_t beams, double fov_deg);

}  // namespace rave::carmen
