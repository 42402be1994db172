// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "carmen/log_text.hpp"
#include "carmen/no_return.hpp"
#include "carmen/stamps.hpp"
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
  LaserSide side = LaserSide::kFront;
  /// A range this long or longer is "no return", metres.
  double range_max_m = 80;
  /// The same, for the range that the log writes for it. Negative: found by find_no_return(); 0:
  /// there is none.
  double no_return_m = -1;
  /// As of StampOptions.
  double rate_hz = 0;
  bool order_suffices = false;
};

/// A part of a CARMEN log in memory. A plain value. Scans and odometry ascend in time, extend
/// beyond the window by the margin, and include one sample before that.
struct Log {
  std::int64_t origin_ns = 0;  ///< Absolute stamp of time 0.
  std::int64_t start_ns = 0;
  std::int64_t end_ns = 0;
  std::uint32_t beams = 0;
  std::vector<Scan> scans;
  /// Whether scans have poses: of their own, or those of odometry.
  bool poses = true;
  /// As logged, metres; +infinity: no return; NaN: not known (REP-117).
  std::vector<float> ranges_m;
  std::vector<OdometrySample> odometry;
  recording::StreamReport scan_report;
  recording::StreamReport odometry_report;
  /// Number of ranges without return in the window.
  std::int64_t no_returns = 0;
  /// Number of NaN and negative ranges in the window.
  std::int64_t unknown_rays = 0;
  /// What find_no_return() found.
  std::optional<NoReturn> no_return;
  /// The largest range by the rows themselves, if rays of the log reach it; otherwise 0.
  double maximum_m = 0;
  const ScanMessage* message = nullptr;  ///< Of the scans.
  /// Direction of the first ray, and from ray to ray, by the rows. A step of 0: they do not say.
  double start_rad = 0;
  double step_rad = 0;
  StampedBy stamped_by = StampedBy::kMessage;
  bool mixed_clocks = false;  ///< As of ParsedLog.
  std::vector<PassedOver> passed_over;
  std::vector<std::string> refusals;  ///< The errors of the first rows that were refused.

  [[nodiscard]] std::span<const float> ranges(const Scan& scan) const {
    return std::span(ranges_m).subspan(scan.first, beams);
  }
  /// The poses of the laser.
  [[nodiscard]] recording::PoseTrack track() const;
};

/// Reads the scans of one laser and the odometry of a log, plain or gzipped. A `stretch.txt` beside
/// it (tools/cut_carmen.py) gives origin and window; without it the origin is the earliest stamp.
/// set_stamps() says which stamps those are, keep_one_laser() which scans. Scans without poses get
/// those of the odometry, if there is any, moved by the offset of the laser. Errors: kNotFound,
/// kIo, kInvalidArgument (options; a log without times and without `rate_hz`), kParse (with
/// file:line:column; a file that differs from the one in `stretch.txt`; a log without scans).
[[nodiscard]] Result<Log> load(const std::filesystem::path& path, const LoadOptions& options = {});

/// Does what load() does, for the text of a log. `file` is used in messages.
[[nodiscard]] Result<Log> load_text(const recording::UnpackedText& text, const std::string& file,
                                    const std::optional<recording::Stretch>& stretch,
                                    const LoadOptions& options);

/// Direction of each ray of a scan in the laser frame, radians, counter-clockwise: evenly spaced
/// over the field and symmetric about the x axis, as in `virtual_laser`.
[[nodiscard]] std::vector<double> bearings_rad(std::uint32_t beams, double fov_deg);
/// The directions that the rows of a log give: those of CARMEN, start_angle + i *
/// angular_resolution. With `fov_deg` above 0 those of the function above. Error kInvalidArgument:
/// neither says anything.
[[nodiscard]] Result<std::vector<double>> bearings_rad(const Log& log, double fov_deg);

}  // namespace rave::carmen
