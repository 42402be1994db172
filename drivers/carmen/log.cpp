// SPDX-License-Identifier: Apache-2.0
#include "carmen/log.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "carmen/log_text.hpp"
#include "rave/base/file.hpp"
#include "rave/base/time.hpp"
#include "rave/math/scalar.hpp"
#include "recording/samples.hpp"

namespace rave::carmen {
namespace {

/// Longer stretches without rows are listed in the reports.
constexpr std::int64_t kGap_ns = 500'000'000;

using recording::StreamReport;
using recording::StreamWindow;
using recording::Stretch;

/// First and last absolute stamp of a log.
std::pair<std::int64_t, std::int64_t> stamp_range(const ParsedLog& log) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = 0;
  const auto take = [&](const auto& rows) {
    for (const auto& row : rows) {
      first = std::min(first, row.stamp_ns);
      last = std::max(last, row.stamp_ns);
    }
  };
  take(log.scans);
  take(log.odometry);
  return {first, last};
}

/// The number of scans whose stamp another scan also has; all of them if one has no such stamp.
template <class StampOf>
std::size_t repeats(const std::vector<ScanRow>& scans, StampOf stamp_of) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(scans.size());
  for (const ScanRow& scan : scans) {
    const std::optional<std::int64_t> stamp_ns = stamp_of(scan);
    if (!stamp_ns) return scans.size();
    stamps.push_back(*stamp_ns);
  }
  std::sort(stamps.begin(), stamps.end());
  const auto last = std::unique(stamps.begin(), stamps.end());
  return static_cast<std::size_t>(stamps.end() - last);
}

/// Whether the message stamps of a log are implausible while the logger's are plausible. The two
/// clocks have different epochs, so one clock is used for the whole log.
bool is_better_by_logger(const ParsedLog& log) {
  // 5 %: a good log repeats few stamps, one with a stuck clock nearly all.
  const std::size_t few = log.scans.size() / 20;
  if (repeats(log.scans, [](const ScanRow& scan) { return std::optional(scan.stamp_ns); }) <= few) {
    return false;
  }
  const bool all = std::all_of(log.odometry.begin(), log.odometry.end(),
                               [](const OdometryRow& row) { return row.logged_ns.has_value(); });
  return all && repeats(log.scans, [](const ScanRow& scan) { return scan.logged_ns; }) <= few;
}

void stamp_by_logger(ParsedLog& log) {
  for (ScanRow& scan : log.scans) scan.stamp_ns = *scan.logged_ns;
  for (OdometryRow& row : log.odometry) row.stamp_ns = *row.logged_ns;
}

void take_scans(Log& log, ParsedLog& parsed, const StreamWindow& window, double range_max_m) {
  StreamReport& report = log.scan_report;
  report.repairs = std::move(parsed.scan_repairs);
  recording::sort_rows(parsed.scans, report);
  recording::drop_duplicates(parsed.scans, window, report);
  for (const ScanRow& row : parsed.scans) {
    Scan scan{row.stamp_ns - window.origin_ns, row.X_WL, row.first};
    recording::wrap_heading(scan.X_WL, row.line, report);
    log.scans.push_back(scan);
  }
  // The report counts what the log has; trimming comes after it.
  recording::describe(report, log.scans, window);
  recording::trim(log.scans, window);
  log.beams = parsed.beams;
  // Keep only the ranges of the remaining scans, in order of time.
  for (Scan& scan : log.scans) {
    const std::size_t first = log.ranges_m.size();
    const bool inside = scan.t_ns >= window.start_ns && scan.t_ns <= window.end_ns;
    for (std::size_t i = 0; i < parsed.beams; ++i) {
      // The scans have been sorted, their ranges are still in the order of the file.
      const float range_m = parsed.ranges_m[scan.first + i];
      const bool returned = static_cast<double>(range_m) < range_max_m;
      log.no_returns += inside && !returned ? 1 : 0;
      log.ranges_m.push_back(returned ? range_m : std::numeric_limits<float>::infinity());
    }
    scan.first = first;
  }
}

void take_odometry(Log& log, ParsedLog& parsed, const StreamWindow& window) {
  StreamReport& report = log.odometry_report;
  report.repairs = std::move(parsed.odometry_repairs);
  recording::sort_rows(parsed.odometry, report);
  recording::drop_duplicates(parsed.odometry, window, report);
  for (const OdometryRow& row : parsed.odometry) {
    OdometrySample sample{row.stamp_ns - window.origin_ns, row.X_WR, row.v_mps, row.w_radps};
    recording::wrap_heading(sample.X_WR, row.line, report);
    log.odometry.push_back(sample);
  }
  recording::describe(report, log.odometry, window);
  recording::trim(log.odometry, window);
}

Status check_options(const LoadOptions& options) {
  RAVE_TRY(recording::check_seconds("clock_offset_s", options.clock_offset_s, -1000, 1000));
  if (options.range_max_m > 0 && options.range_max_m <= 1000) return {};
  return fail(ErrorCode::kInvalidArgument, "range_max_m is {}: expected more than 0, at most 1000",
              options.range_max_m);
}

}  // namespace

recording::PoseTrack Log::track() const {
  std::vector<recording::PoseSample> samples;
  samples.reserve(scans.size());
  for (const Scan& scan : scans) samples.push_back({scan.t_ns, scan.X_WL});
  return recording::PoseTrack(std::move(samples));
}

Result<Log> load_text(const recording::UnpackedText& text, const std::string& file,
                      const std::optional<Stretch>& stretch, const LoadOptions& options) {
  RAVE_TRY(check_options(options));
  RAVE_TRY_ASSIGN(ParsedLog parsed, parse_log(text, file, options.accept_cut));
  if (parsed.scans.empty()) {
    return fail_at({file, 0, 0}, ErrorCode::kParse,
                   "the log has no FLASER row; other messages are not read");
  }
  // The origin in `stretch.txt` is an `ipc_timestamp`.
  const bool by_logger = !stretch && is_better_by_logger(parsed);
  if (by_logger) stamp_by_logger(parsed);
  const auto [first_ns, last_ns] = stamp_range(parsed);
  RAVE_TRY_ASSIGN(StreamWindow window,
                  recording::choose_window(stretch, first_ns, last_ns, options.window, file));
  Log log;
  log.origin_ns = window.origin_ns;
  log.start_ns = window.start_ns;
  log.end_ns = window.end_ns;
  log.passed_over = parsed.passed_over;
  log.by_logger = by_logger;
  log.scan_report.gap_limit_ns = log.odometry_report.gap_limit_ns = kGap_ns;
  // Moving the origin back is equivalent to adding the offset to all stamps.
  window.origin_ns -= from_seconds(options.clock_offset_s).ns;
  take_scans(log, parsed, window, options.range_max_m);
  take_odometry(log, parsed, window);
  if (log.scans.empty()) {
    return fail_at({file, 0, 0}, ErrorCode::kParse,
                   "the log has no scan up to the end of the window at {} s",
                   Duration{window.end_ns}.seconds());
  }
  return log;
}

Result<Log> load(const std::filesystem::path& path, const LoadOptions& options) {
  RAVE_TRY_ASSIGN(const std::string bytes, read_file(path, recording::kMostLogBytes));
  RAVE_TRY_ASSIGN(const auto stretch, recording::read_stretch(path.parent_path()));
  RAVE_TRY_ASSIGN(const recording::UnpackedText text, recording::unpack_text(bytes, path.string()));
  RAVE_TRY_ASSIGN(Log log, load_text(text, path.string(), stretch, options));
  // Last, so that a syntax error is reported with its line instead.
  RAVE_TRY_ASSIGN(const recording::LogIdentity file,
                  recording::identify(path, bytes, log.scan_report.repairs, stretch));
  static_cast<recording::LogIdentity&>(log.scan_report) = file;
  static_cast<recording::LogIdentity&>(log.odometry_report) = file;
  return log;
}

std::vector<double> bearings_rad(std::uint32_t beams, double fov_deg) {
  std::vector<double> bearings(beams, 0.0);
  if (beams < 2) return bearings;
  // A full circle has as many gaps as rays, because the last ray is followed by the first.
  const auto gaps = static_cast<double>(fov_deg < 360 ? beams - 1 : beams);
  for (std::uint32_t i = 0; i < beams; ++i) {
    bearings[i] = deg_to_rad(fov_deg * (static_cast<double>(i) / gaps - 0.5));
  }
  return bearings;
}

}  // namespace rave::carmen
