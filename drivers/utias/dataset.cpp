// SPDX-License-Identifier: Apache-2.0
#include "utias/dataset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "rave/base/time.hpp"
#include "utias/folder.hpp"
#include "utias/streams.hpp"

namespace rave::utias {
namespace {

using recording::check_seconds;

/// The three logs of one robot.
struct RobotFiles {
  LogFile poses;
  LogFile odometry;
  LogFile sightings;
};

Status check_options(const LoadOptions& options) {
  RAVE_TRY(check_seconds("clock_offset_s", options.clock_offset_s, -1000, 1000));
  RAVE_TRY(check_seconds("state_clock_offset_s", options.state_clock_offset_s, -1000, 1000));
  if (options.robots.empty()) return fail(ErrorCode::kInvalidArgument, "no robot requested");
  for (auto robot = options.robots.begin(); robot != options.robots.end(); ++robot) {
    if (std::find(options.robots.begin(), robot, *robot) == robot) continue;
    return fail(ErrorCode::kInvalidArgument, "robot {} requested twice", *robot);
  }
  return {};
}

Status check_robots(const Folder& folder, const LoadOptions& options) {
  const std::vector<int>& present = folder.robots();
  for (const int robot : options.robots) {
    if (std::find(present.begin(), present.end(), robot) != present.end()) continue;
    std::string names;
    for (const int number : present)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", number);
    return fail(ErrorCode::kNotFound, "`{}` has no logs of robot {}; it has robots: {}",
                folder.path().string(), robot, names.empty() ? "none" : names);
  }
  return {};
}

Result<RobotFiles> read_robot(const Folder& folder, int robot, const StreamChoice& streams,
                              const LoadOptions& options) {
  const std::string prefix = fmt::format("Robot{}_", robot);
  RobotFiles files;
  // Only the logs that are asked for: a player of poses must not fail because of a damaged log of
  // sightings.
  if (streams.poses) {
    RAVE_TRY_ASSIGN(files.poses,
                    folder.read(prefix + "Groundtruth", pose_columns(), options.accept_cut));
  }
  if (streams.odometry) {
    RAVE_TRY_ASSIGN(files.odometry,
                    folder.read(prefix + "Odometry", odometry_columns(), options.accept_cut));
  }
  if (streams.sightings) {
    RAVE_TRY_ASSIGN(files.sightings,
                    folder.read(prefix + "Measurement", sighting_columns(), options.accept_cut));
  }
  return files;
}

/// First and last absolute stamp of all logs.
std::pair<std::int64_t, std::int64_t> stamp_range(const std::map<int, RobotFiles>& robots) {
  std::int64_t first = std::numeric_limits<std::int64_t>::max();
  std::int64_t last = 0;
  for (const auto& [number, files] : robots) {
    for (const LogFile* file : {&files.poses, &files.odometry, &files.sightings}) {
      for (const LogRow& row : file->log.rows) {
        first = std::min(first, row.stamp_ns);
        last = std::max(last, row.stamp_ns);
      }
    }
  }
  return {first, last};
}

Status add_poses(RobotLog& robot, LogFile file, const StreamWindow& window) {
  const std::string path = file.path;
  auto poses = make_poses(std::move(file), robot.subject, window);
  // A real robot without any pose would never exist in the world.
  if (poses.samples.empty()) {
    return fail_at({path, 0, 0}, ErrorCode::kParse,
                   "robot {} has no pose up to the end of the window at {} s", robot.subject,
                   Duration{window.end_ns}.seconds());
  }
  robot.poses = PoseTrack(std::move(poses.samples));
  robot.pose_report = std::move(poses.report);
  return {};
}

Result<RobotLog> make_robot(int number, RobotFiles files, const StreamWindow& window,
                            const LoadOptions& options, const Subjects& subjects) {
  RobotLog robot;
  robot.subject = number;
  // Moving the origin back is equivalent to adding the offset to all stamps.
  StreamWindow state_window = window;
  state_window.origin_ns -= from_seconds(options.state_clock_offset_s).ns;
  if (options.streams.poses) {
    RAVE_TRY(add_poses(robot, std::move(files.poses), state_window));
  }
  if (options.streams.odometry) {
    auto odometry = make_odometry(std::move(files.odometry), number, state_window);
    robot.odometry = std::move(odometry.samples);
    robot.odometry_report = std::move(odometry.report);
  }
  if (options.streams.sightings) {
    auto sightings =
        make_sightings(std::move(files.sightings), number, window,
                       from_seconds(options.clock_offset_s).ns, options.code_meaning, subjects);
    robot.sightings = std::move(sightings.samples);
    robot.sighting_report = std::move(sightings.report);
  }
  return robot;
}

Result<Subjects> read_subjects(const Folder& folder, const LoadOptions& options) {
  RAVE_TRY_ASSIGN(const LogFile barcodes,
                  folder.read("Barcodes", barcode_columns(), options.accept_cut));
  RAVE_TRY_ASSIGN(const LogFile landmarks,
                  folder.read("Landmark_Groundtruth", landmark_columns(), options.accept_cut));
  return Subjects::join(barcodes.log.rows, barcodes.path, landmarks.log.rows, landmarks.path,
                        folder.robots());
}

}  // namespace

const RobotLog* Dataset::robot(int subject) const noexcept {
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [&](const RobotLog& log) { return log.subject == subject; });
  return found == robots.end() ? nullptr : &*found;
}

Result<Dataset> load(const std::filesystem::path& path, const LoadOptions& options) {
  RAVE_TRY(check_options(options));
  RAVE_TRY_ASSIGN(const Folder folder, Folder::open(path));
  RAVE_TRY(check_robots(folder, options));
  Dataset data;
  RAVE_TRY_ASSIGN(data.subjects, read_subjects(folder, options));
  std::map<int, RobotFiles> files;
  // Without a stated origin, read all robots: the earliest stamp may belong to one that was not
  // requested.
  const StreamChoice streams = folder.stretch() ? options.streams : StreamChoice{};
  for (const int robot : folder.stretch() ? options.robots : folder.robots()) {
    RAVE_TRY_ASSIGN(files[robot], read_robot(folder, robot, streams, options));
  }
  const auto [first_ns, last_ns] = stamp_range(files);
  RAVE_TRY_ASSIGN(
      const StreamWindow window,
      recording::choose_window(folder.stretch(), first_ns, last_ns,
                               {options.start_s, options.end_s, options.margin_s}, path.string()));
  data.origin_ns = window.origin_ns;
  data.start_ns = window.start_ns;
  data.end_ns = window.end_ns;
  for (const int number : options.robots) {
    RAVE_TRY_ASSIGN(RobotLog robot,
                    make_robot(number, std::move(files[number]), window, options, data.subjects));
    data.robots.push_back(std::move(robot));
  }
  return data;
}

}  // namespace rave::utias
