// SPDX-License-Identifier: Apache-2.0
#include "carmen/log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "carmen/log_text.hpp"
#include "carmen/one_laser.hpp"
#include "rave/base/file.hpp"
#include "rave/base/time.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/trigonometry.hpp"
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

/// Where the odometry was at a time, on a straight line between two rows; at the ends the nearest.
Pose2 pose_at(const std::vector<OdometrySample>& odometry, std::int64_t t_ns) {
  const auto next = std::ranges::upper_bound(odometry, t_ns, {}, &OdometrySample::t_ns);
  if (next == odometry.begin()) return odometry.front().X_WR;
  if (next == odometry.end()) return odometry.back().X_WR;
  const OdometrySample& a = *(next - 1);
  const double share =
      static_cast<double>(t_ns - a.t_ns) / static_cast<double>(next->t_ns - a.t_ns);
  const Vec2 p = a.X_WR.position() + share * (next->X_WR.position() - a.X_WR.position());
  return {p.x, p.y, a.X_WR.yaw + share * recording::wrap_angle(next->X_WR.yaw - a.X_WR.yaw)};
}

/// The poses of scans that have none. The odometry must be whole, not cut to the window.
void pose_by_odometry(ParsedLog& parsed, const std::vector<OdometrySample>& odometry,
                      const StreamWindow& window) {
  if (odometry.empty()) return;
  for (ScanRow& row : parsed.scans) {
    if (row.X_WL) continue;
    Pose2 X_WL = pose_at(odometry, row.stamp_ns - window.origin_ns);
    const SinCos heading = sincos(X_WL.yaw);
    X_WL.x += parsed.laser_offset_m * heading.cos;
    X_WL.y += parsed.laser_offset_m * heading.sin;
    row.X_WL = X_WL;
  }
}

/// From which range on there was no return.
double no_return_limit(Log& log, const ParsedLog& parsed, const LoadOptions& options) {
  double limit_m = options.range_max_m;
  if (options.no_return_m > 0) return std::min(limit_m, options.no_return_m);
  if (options.no_return_m == 0) return limit_m;
  // Of the kept scans only: others may be those of another laser.
  std::vector<float> ranges_m;
  for (const ScanRow& row : parsed.scans) {
    const auto ranges = parsed.ranges(row);
    ranges_m.insert(ranges_m.end(), ranges.begin(), ranges.end());
  }
  const double maximum_m = parsed.scans.front().maximum_m;
  const auto reaches = [&](float range_m) { return static_cast<double>(range_m) >= maximum_m; };
  if (maximum_m > 0 && maximum_m < limit_m && std::ranges::any_of(ranges_m, reaches)) {
    log.maximum_m = limit_m = maximum_m;
  }
  log.no_return = find_no_return(ranges_m, limit_m);
  return log.no_return ? static_cast<double>(log.no_return->range_m) : limit_m;
}

/// Keeps the ranges of the remaining scans, in order of time.
void take_ranges(Log& log, const ParsedLog& parsed, double limit_m) {
  for (Scan& scan : log.scans) {
    const std::size_t first = log.ranges_m.size();
    const bool inside = scan.t_ns >= log.start_ns && scan.t_ns <= log.end_ns;
    for (std::size_t i = 0; i < log.beams; ++i) {
      // The scans have been sorted, their ranges are still in the order of the file.
      const float range_m = parsed.ranges_m[scan.first + i];
      const bool none = static_cast<double>(range_m) >= limit_m;
      log.no_returns += inside && none ? 1 : 0;
      log.unknown_rays += inside && std::isnan(range_m) ? 1 : 0;
      log.ranges_m.push_back(none ? std::numeric_limits<float>::infinity() : range_m);
    }
    scan.first = first;
  }
}

void take_scans(Log& log, ParsedLog& parsed, const StreamWindow& window,
                const LoadOptions& options) {
  const double limit_m = no_return_limit(log, parsed, options);
  StreamReport& report = log.scan_report;
  report.repairs = std::move(parsed.scan_repairs);
  recording::sort_rows(parsed.scans, report);
  recording::drop_duplicates(parsed.scans, window, report);
  for (const ScanRow& row : parsed.scans) {
    Scan scan{row.stamp_ns - window.origin_ns, row.X_WL.value_or(Pose2{}), row.first};
    recording::wrap_heading(scan.X_WL, row.line, report);
    log.scans.push_back(scan);
  }
  // The report counts what the log has; trimming comes after it.
  recording::describe(report, log.scans, window);
  recording::trim(log.scans, window);
  take_ranges(log, parsed, limit_m);
}

/// All of it, also outside of the window.
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
}

/// What does not depend on the window.
void describe_scans(Log& log, ParsedLog& parsed) {
  const ScanRow& row = parsed.scans.front();
  log.message = row.message;
  log.beams = row.beams;
  log.mixed_clocks = parsed.mixed_clocks;
  log.start_rad = row.start_rad;
  log.step_rad = row.step_rad;
  log.passed_over = std::move(parsed.passed_over);
  log.refusals = std::move(parsed.refusals);
}

Status check_options(const LoadOptions& options) {
  RAVE_TRY(recording::check_seconds("clock_offset_s", options.clock_offset_s, -1000, 1000));
  if (!(options.range_max_m > 0 && options.range_max_m <= 1000)) {
    return fail(ErrorCode::kInvalidArgument,
                "range_max_m is {}: expected more than 0, at most 1000", options.range_max_m);
  }
  if (options.rate_hz == 0 || (options.rate_hz >= 0.001 && options.rate_hz <= 1000)) return {};
  return fail(ErrorCode::kInvalidArgument, "rate_hz is {}: expected 0, or 0.001 to 1000",
              options.rate_hz);
}

/// Why a log has no scan that can be used, or only one.
Error too_few_scans(const ParsedLog& parsed, const std::string& file, LaserSide side) {
  std::string text = fmt::format("the log has {} scan of the {} laser (",
                                 parsed.scans.empty() ? "no" : "only one usable",
                                 side == LaserSide::kFront ? "front" : "rear");
  const char* separator = "";
  for (const ScanMessage& message : kScanMessages) {
    if (message.side != side) continue;
    text += fmt::format("{}{}", std::exchange(separator, ", "), message.name);
  }
  text += ')';
  separator = "; it has ";
  for (const PassedOver& other : parsed.passed_over) {
    text += fmt::format("{}{} x {}", std::exchange(separator, ", "), other.count, other.name);
  }
  std::int64_t refused = 0;
  for (const auto* repairs : {&parsed.scan_repairs, &parsed.odometry_repairs}) {
    for (const recording::Repair& repair : *repairs) {
      if (repair.kind == recording::RepairKind::kRefusedRow) refused += repair.count;
    }
  }
  if (refused > 0) {
    text += fmt::format("; {} rows are refused, the first: {}", refused, parsed.refusals.front());
  }
  return fail_at({file, 0, 0}, ErrorCode::kParse, "{}", text).value();
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
  RAVE_TRY_ASSIGN(ParsedLog parsed, parse_log(text, file, options.accept_cut, options.side));
  keep_one_laser(parsed, file);
  if (parsed.scans.empty()) return tl::unexpected(too_few_scans(parsed, file, options.side));
  Log log;
  // The origin in `stretch.txt` is an `ipc_timestamp`.
  RAVE_TRY_ASSIGN(
      log.stamped_by,
      set_stamps(parsed, file, {options.rate_hz, options.order_suffices, stretch.has_value()}));
  if (parsed.scans.empty()) return tl::unexpected(too_few_scans(parsed, file, options.side));
  const auto [first_ns, last_ns] = stamp_range(parsed);
  if (!stretch && first_ns == last_ns) {
    return tl::unexpected(too_few_scans(parsed, file, options.side));
  }
  RAVE_TRY_ASSIGN(StreamWindow window,
                  recording::choose_window(stretch, first_ns, last_ns, options.window, file));
  describe_scans(log, parsed);
  log.origin_ns = window.origin_ns;
  log.start_ns = window.start_ns;
  log.end_ns = window.end_ns;
  log.scan_report.gap_limit_ns = log.odometry_report.gap_limit_ns = kGap_ns;
  // Moving the origin back is equivalent to adding the offset to all stamps.
  window.origin_ns -= from_seconds(options.clock_offset_s).ns;
  take_odometry(log, parsed, window);
  pose_by_odometry(parsed, log.odometry, window);
  log.poses = parsed.scans.front().X_WL.has_value();
  recording::trim(log.odometry, window);
  take_scans(log, parsed, window, options);
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

Result<std::vector<double>> bearings_rad(const Log& log, double fov_deg) {
  if (fov_deg > 0 || log.beams < 2) return bearings_rad(log.beams, fov_deg);
  if (!(log.step_rad > 0)) {
    return fail(ErrorCode::kInvalidArgument,
                "`fov_deg` is needed: {} rows do not say where their {} rays point",
                log.message->name, log.beams);
  }
  std::vector<double> bearings(log.beams);
  for (std::uint32_t i = 0; i < log.beams; ++i) {
    bearings[i] = log.start_rad + static_cast<double>(i) * log.step_rad;
  }
  return bearings;
}

}  // namespace rave::carmen
