// SPDX-License-Identifier: Apache-2.0
#include "rave/replay/run_diff.hpp"

#include <algorithm>
#include <cmath>

#include "rave/record/merge.hpp"
#include "rave/record/run_reader.hpp"
#include "record_match.hpp"

namespace rave::runtime {
namespace {

using Track = std::vector<record::PoseTrackPoint>;

std::optional<Pose2> pose_of(const record::PoseTrackPoint& point) {
  return point.true_pose ? point.true_pose : point.reported_pose;
}

/// Both tracks have one point per step; points of equal times are compared.
RobotDistance distance_of(std::string name, const Track& a, const Track& b, double& common_s) {
  RobotDistance distance;
  distance.robot = std::move(name);
  std::size_t other = 0;
  for (const record::PoseTrackPoint& point : a) {
    while (other < b.size() && b[other].time.ns < point.time.ns) ++other;
    if (other == b.size()) break;
    if (b[other].time.ns != point.time.ns) continue;
    const auto one = pose_of(point);
    const auto two = pose_of(b[other]);
    if (!one || !two) continue;
    const double time_s = point.time.seconds();
    common_s = std::max(common_s, time_s);
    distance.last_m = std::hypot(one->x - two->x, one->y - two->y);
    if (distance.last_m > 0 && !distance.from_s) distance.from_s = time_s;
    if (distance.last_m > distance.most_m) {
      distance.most_m = distance.last_m;
      distance.most_at_s = time_s;
    }
  }
  return distance;
}

}  // namespace

Result<RunDiff> diff_runs(const std::filesystem::path& first, const std::filesystem::path& second) {
  RAVE_TRY_ASSIGN(const auto a, record::McapReader::open(first));
  RAVE_TRY_ASSIGN(const auto b, record::McapReader::open(second));
  RAVE_TRY_ASSIGN(const record::RunInfo run_a, record::read_run_info(a));
  RAVE_TRY_ASSIGN(const record::RunInfo run_b, record::read_run_info(b));
  if (run_a.step_s != run_b.step_s) {
    return fail(ErrorCode::kInvalidArgument,
                "the runs have steps of {:g} and {:g} s; expected the same, as places are compared "
                "step by step",
                run_a.step_s, run_b.step_s);
  }
  RunDiff diff;
  RAVE_TRY_ASSIGN(RecordMatch match,
                  match_records(a, b, run_a, {true, record::is_merged(a) || record::is_merged(b)}));
  diff.first = std::move(match.difference);
  diff.messages = match.messages;
  for (const record::RecordedRobot& robot : run_a.robots) {
    const auto twin = std::ranges::find(run_b.robots, robot.name, &record::RecordedRobot::name);
    if (twin == run_b.robots.end()) {
      diff.only_first.push_back(robot.name);
      continue;
    }
    RAVE_TRY_ASSIGN(const Track track_a, record::read_poses(a, robot.id));
    RAVE_TRY_ASSIGN(const Track track_b, record::read_poses(b, twin->id));
    diff.robots.push_back(distance_of(robot.name, track_a, track_b, diff.common_s));
  }
  for (const record::RecordedRobot& robot : run_b.robots) {
    if (std::ranges::find(run_a.robots, robot.name, &record::RecordedRobot::name) ==
        run_a.robots.end()) {
      diff.only_second.push_back(robot.name);
    }
  }
  if (diff.robots.empty()) {
    return fail(ErrorCode::kInvalidArgument, "the runs have no robot of one name in common");
  }
  return diff;
}

}  // namespace rave::runtime
