// SPDX-License-Identifier: Apache-2.0
#include "rave/replay/gap.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "gap_source.hpp"
#include "gap_twin.hpp"
#include "rave/math/transform.hpp"
#include "rave/recording/recorded_scenario.hpp"

namespace rave::runtime {
// The comparison has two views. follow() integrates the twin from the first pose to the end: errors
// of heading add up, so its gap grows with the way. start_anew() puts the twin back at the robot's
// pose at the beginning of each window: its gaps are those of one window and comparable between
// drives of different length.
namespace {

constexpr std::array kMoments_s = {10.0, 30.0, 60.0};

double metres_between(const Pose2& a, const Pose2& b) {
  return std::sqrt(squared_norm(a.position() - b.position()));
}
double degrees_between(const Pose2& a, const Pose2& b) {
  return rad_to_deg(std::abs(wrap_angle(a.yaw - b.yaw)));
}

/// The velocities of the twin: step `first + i` has `twists[i]`. They do not depend on its pose, so
/// all windows share them.
struct Drive {
  std::uint64_t first = 0;
  std::int64_t step_ns = 0;
  std::vector<Twist2> twists;

  [[nodiscard]] SimTime time(std::size_t i) const noexcept {
    return {static_cast<std::int64_t>(first + i) * step_ns};
  }
  [[nodiscard]] double step_s() const noexcept { return Duration{step_ns}.seconds(); }
};

Result<Drive> drive(GapTwin& twin, const GapCommands& commands, const GapTrack& track,
                    std::int64_t step_ns) {
  Drive result;
  result.step_ns = step_ns;
  const std::int64_t first_ns = std::max<std::int64_t>(track.first().ns, 0);
  // Rounded up to the first step that is not before the first pose, because the track does not
  // extrapolate.
  result.first = static_cast<std::uint64_t>((first_ns + step_ns - 1) / step_ns);
  const auto end = static_cast<std::uint64_t>(std::max<std::int64_t>(track.last().ns, 0) / step_ns);
  if (end <= result.first) {
    return fail(ErrorCode::kInvalidArgument,
                "the pose is known in fewer than two steps, so there is nothing to compare");
  }
  // A twin with inertia also depends on its commands before the first pose.
  for (std::uint64_t k = 0; k < end; ++k) {
    const SimTime now{static_cast<std::int64_t>(k) * step_ns};
    RAVE_TRY_ASSIGN(const Twist2 twist, twin.propose(commands.at(now), k));
    if (k >= result.first) result.twists.push_back(twist);
  }
  return result;
}

void note_moment(GapReport& report, double after_s, const Pose2& X_WR, const Pose2& X_WT) {
  report.after.push_back({after_s, metres_between(X_WR, X_WT), degrees_between(X_WR, X_WT)});
}

/// The whole drive from the first pose on, without restarts.
void follow(const Drive& drive, const GapTrack& track, GapReport& report) {
  Pose2 X_WT = *track.at(drive.time(0));
  double squares_m2 = 0;
  double squares_deg2 = 0;
  std::size_t moment = 0;
  for (std::size_t i = 0; i <= drive.twists.size(); ++i) {
    if (i > 0) {
      const Pose2 X_before = X_WT;
      X_WT = integrate(X_WT, drive.twists[i - 1], drive.step_s());
      report.driven_m += metres_between(X_before, X_WT);
    }
    const auto X_WR = track.at(drive.time(i));
    // A gap of the track: the twin keeps driving, but there is nothing to compare it with.
    if (!X_WR) continue;
    const double after_s = (drive.time(i) - drive.time(0)).seconds();
    const double metres = metres_between(*X_WR, X_WT);
    const double degrees = degrees_between(*X_WR, X_WT);
    squares_m2 += metres * metres;
    squares_deg2 += degrees * degrees;
    if (metres > report.largest.metres) report.largest = {after_s, metres, degrees};
    report.largest_deg = std::max(report.largest_deg, degrees);
    report.points.push_back({drive.time(i), *X_WR, X_WT});
    // Half a step of tolerance, so that rounding of times does not move a moment to the next step.
    while (moment < kMoments_s.size() && after_s > kMoments_s[moment] - 0.5 * drive.step_s()) {
      note_moment(report, kMoments_s[moment++], *X_WR, X_WT);
    }
  }
  const GapReport::Point& last = report.points.back();
  const double end_s = (last.time - drive.time(0)).seconds();
  if (report.after.empty() || end_s > report.after.back().after_s + drive.step_s()) {
    note_moment(report, end_s, last.X_WR, last.X_WT);
  }
  const auto count = static_cast<double>(report.points.size());
  report.rms_m = std::sqrt(squares_m2 / count);
  report.rms_deg = std::sqrt(squares_deg2 / count);
  report.duration_s = end_s;
}

/// The percentile by the nearest-rank method; `values` must be sorted.
double percentile(const std::vector<double>& values, double percent) {
  const double rank = std::ceil(percent / 100 * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

/// Drives of one window each; each restarts at the recorded pose of the robot.
GapWindows start_anew(const Drive& drive, const GapTrack& track, double window_s) {
  GapWindows windows;
  windows.window_s = window_s;
  const auto length =
      static_cast<std::size_t>(std::max(1.0, std::round(window_s / drive.step_s())));
  std::vector<double> metres;
  std::vector<double> degrees;
  // Windows do not overlap, and an incomplete one at the end is omitted: its gap would be that of a
  // shorter drive.
  for (std::size_t first = 0; first + length <= drive.twists.size(); first += length) {
    const auto start = track.at(drive.time(first));
    const auto end = track.at(drive.time(first + length));
    if (!start || !end) continue;
    Pose2 X_WT = *start;
    for (std::size_t i = 0; i < length; ++i) {
      X_WT = integrate(X_WT, drive.twists[first + i], drive.step_s());
    }
    metres.push_back(metres_between(*end, X_WT));
    degrees.push_back(degrees_between(*end, X_WT));
  }
  windows.count = metres.size();
  if (metres.empty()) return windows;
  std::ranges::sort(metres);
  std::ranges::sort(degrees);
  windows.median_m = percentile(metres, 50);
  windows.p95_m = percentile(metres, 95);
  windows.median_deg = percentile(degrees, 50);
  windows.p95_deg = percentile(degrees, 95);
  return windows;
}

Result<const record::RecordedRobot*> chosen_robot(const record::RunInfo& run,
                                                  const std::string& name) {
  if (!name.empty()) return record::find_robot(run, name);
  if (run.robots.size() == 1) return &run.robots.front();
  std::string names;
  for (const record::RecordedRobot& robot : run.robots) {
    if (names.size() > 200) {
      names += ", ...";
      break;
    }
    names += (names.empty() ? "" : ", ") + robot.name;
  }
  return fail(ErrorCode::kInvalidArgument,
              "the recording has {} robots; choose one with --robot: {}", run.robots.size(), names);
}

Result<GapTwin> make_twin(const GapSource& source, const GapOptions& options,
                          plugin::Catalogue& catalogue) {
  config::RobotFile file = source.file();
  std::filesystem::path path;
  if (!options.twin.empty()) {
    RAVE_TRY_ASSIGN(file, config::read_robot_file(options.twin));
    path = options.twin;
  }
  return GapTwin::make(std::move(file), path, source.run.step_s, source.run.seed, source.robot.id,
                       catalogue);
}

}  // namespace

Result<GapReport> measure_gap(const std::filesystem::path& record, plugin::Catalogue& catalogue,
                              const GapOptions& options) {
  RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(record));
  RAVE_TRY_ASSIGN(const record::RunInfo run, record::read_run_info(reader));
  RAVE_TRY_ASSIGN(const auto* const robot, chosen_robot(run, options.robot));
  RAVE_TRY_ASSIGN(const RecordedScenario recorded, recorded_scenario(reader, run, record));
  const config::ExpandedScenario& scenario = recorded.scenario;
  if (robot->id.value() >= scenario.robots.size() || from_seconds(run.step_s).ns <= 0) {
    return fail(ErrorCode::kParse, "the scenario in the recording does not match its robots");
  }
  const GapSource source{reader, run, *robot, scenario};
  RAVE_TRY_ASSIGN(GapTwin twin, make_twin(source, options, catalogue));
  GapReport report;
  report.robot = robot->name;
  report.twin = options.twin.empty()
                    ? fmt::format("`{}` of its own file", twin.driver())
                    : fmt::format("`{}` of {}", twin.driver(), options.twin.string());
  RAVE_TRY_ASSIGN(const GapTrack track, read_track(source, options.truth, report.pose));
  RAVE_TRY_ASSIGN(const GapCommands commands,
                  read_commands(source, options.commands, twin.accepts()));
  report.commands = commands.source;
  RAVE_TRY_ASSIGN(const Drive driven, drive(twin, commands, track, from_seconds(run.step_s).ns));
  report.start_s = driven.time(0).seconds();
  if (!track.at(driven.time(0))) {
    return fail(ErrorCode::kInvalidArgument, "the pose of robot `{}` has gaps at the beginning",
                robot->name);
  }
  report.steps = driven.twists.size() + 1;
  follow(driven, track, report);
  // The first point is the start of the twin, so it has no gap.
  if (report.points.size() < 2) {
    return fail(ErrorCode::kInvalidArgument,
                "the pose of robot `{}` is known only in the first of {} steps, so there is "
                "nothing to compare",
                robot->name, report.steps);
  }
  report.windows = start_anew(driven, track, options.window_s);
  return report;
}

}  // namespace rave::runtime
