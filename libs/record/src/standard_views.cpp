// SPDX-License-Identifier: Apache-2.0
// The same data in standard messages of ROS, at a lower rate, so that foreign viewers show a
// recording without knowing RAVE.
#include "standard_views.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "cdr_time.hpp"
#include "rave/math/even_angles.hpp"
#include "rave/math/scalar.hpp"

namespace rave::record {
namespace {

constexpr std::string_view kWorldFrame = "world";
/// Up to this many robots `/tf` has the requested rate; beyond, the rate decreases.
constexpr std::size_t kFullRateRobots = 100;

}  // namespace

Status StandardViews::open(McapWriter& file, const RunInfo& info, const ViewOptions& options) {
  if (!(options.rate_hz > 0)) return {};
  period_ns_ = std::max<std::int64_t>(1, from_seconds(1.0 / options.rate_hz).ns);
  robots_ = options.robots;
  // The rate decreases with the number of robots, so that the number of transforms per second is
  // bounded.
  const auto crowd =
      static_cast<std::int64_t>((info.robots.size() + kFullRateRobots - 1) / kFullRateRobots);
  tf_period_ns_ = period_ns_ * std::max<std::int64_t>(1, crowd);
  for (const RecordedRobot& robot : info.robots) {
    if (frames_.size() <= robot.id.value()) frames_.resize(robot.id.value() + std::size_t{1}, "?");
    frames_[robot.id.value()] = robot.name;
  }
  RAVE_TRY_ASSIGN(const auto schema, add_schema(file, kTfSchema));
  RAVE_TRY_ASSIGN(tf_.stream, add_stream(file, "/tf", schema));
  RAVE_TRY(open_scans(file, info));
  RAVE_TRY(open_velocities(file, info));
  // Mountings do not change, so they are written once, on the topic that viewers keep.
  if (scans_.empty()) return {};
  RAVE_TRY_ASSIGN(Stream fixed, add_stream(file, "/tf_static", schema));
  RAVE_TRY(write_mountings(file, info));
  return fixed.write(file, SimTime{}, cdr_.bytes());
}

Status StandardViews::open_scans(McapWriter& file, const RunInfo& info) {
  std::uint16_t schema = 0;
  for (const RecordedSensor& sensor : info.sensors) {
    // Others have no standard message; they are in the recording all the same.
    if (sensor.kind != kRangesKind || !sees(sensor.robot) ||
        sensor.robot.value() >= frames_.size() || !evenly_spread(sensor.bearings_rad)) {
      continue;
    }
    if (schema == 0) {
      RAVE_TRY_ASSIGN(schema, add_schema(file, kLaserScanSchema));
    }
    Scan scan;
    scan.frame = frames_[sensor.robot.value()] + "/" + sensor.name;
    const auto& bearings = sensor.bearings_rad;
    scan.angle_min = static_cast<float>(bearings.front());
    scan.angle_max = static_cast<float>(bearings.back());
    scan.increment = bearings.size() > 1 ? static_cast<float>(bearings[1] - bearings[0]) : 0;
    scan.period = static_cast<float>(sensor.period_s);
    scan.range_min = static_cast<float>(sensor.range_min_m);
    scan.range_max = static_cast<float>(sensor.range_max_m);
    RAVE_TRY_ASSIGN(scan.paced.stream, add_stream(file, "/" + scan.frame, schema));
    scans_[{sensor.robot, sensor.sensor}] = std::move(scan);
  }
  return {};
}

Status StandardViews::open_velocities(McapWriter& file, const RunInfo& info) {
  std::uint16_t schema = 0;
  for (const RecordedRobot& robot : info.robots) {
    if (!sees(robot.id)) continue;
    if (schema == 0) {
      RAVE_TRY_ASSIGN(schema, add_schema(file, kTwistSchema));
    }
    RAVE_TRY_ASSIGN(velocities_[robot.id].stream,
                    add_stream(file, "/" + robot.name + "/cmd_vel", schema));
  }
  return {};
}

bool StandardViews::due(Paced& paced, SimTime time, std::int64_t period_ns) noexcept {
  if (time.ns < paced.next_ns) return false;
  // Kept on a grid of periods, and no burst after a gap.
  paced.next_ns = std::max(paced.next_ns, time.ns - period_ns) + period_ns;
  if (paced.next_ns <= time.ns) paced.next_ns = time.ns + period_ns;
  return true;
}

void StandardViews::put_transform(SimTime time, std::string_view parent, std::string_view child,
                                  const Pose2& X, double z_m) {
  put_time(cdr_, time);
  cdr_.put_string(parent);
  cdr_.put_string(child);
  // A turn about z by yaw is the quaternion (0, 0, sin(yaw/2), cos(yaw/2)).
  for (const double value : {X.x, X.y, z_m, 0.0, 0.0, sin(X.yaw / 2), cos(X.yaw / 2)}) {
    cdr_.put(value);
  }
}

Status StandardViews::write_mountings(McapWriter&, const RunInfo& info) {
  cdr_.clear();
  cdr_.put_count(scans_.size());
  for (const RecordedSensor& sensor : info.sensors) {
    const auto scan = scans_.find({sensor.robot, sensor.sensor});
    if (scan == scans_.end()) continue;
    put_transform(SimTime{}, frames_[sensor.robot.value()], scan->second.frame, sensor.X_RS,
                  sensor.z_m);
  }
  return {};
}

Status StandardViews::poses(McapWriter& file, SimTime time, std::span<const RobotPose> robots) {
  const auto placed = [](const RobotPose& pose) { return pose.reported_pose || pose.true_pose; };
  cdr_.clear();
  cdr_.put_count(static_cast<std::size_t>(std::ranges::count_if(robots, placed)));
  for (const RobotPose& pose : robots) {
    if (!placed(pose)) continue;
    const std::uint32_t robot = pose.robot.value();
    put_transform(time, kWorldFrame, robot < frames_.size() ? frames_[robot] : "?",
                  pose.reported_pose ? *pose.reported_pose : *pose.true_pose, 0);
  }
  return tf_.stream.write(file, time, cdr_.bytes());
}

Status StandardViews::percept(McapWriter& file, SimTime time, const Percept& percept) {
  const auto found = scans_.find({percept.robot, percept.sensor});
  if (found == scans_.end() || !due(found->second.paced, time, period_ns_)) return {};
  Scan& scan = found->second;
  cdr_.clear();
  put_time(cdr_, SimTime{percept.header.stamp_ns});
  cdr_.put_string(scan.frame);
  // The fourth is the time between rays: all of a reading have one stamp.
  for (const float value : {scan.angle_min, scan.angle_max, scan.increment, 0.0F, scan.period,
                            scan.range_min, scan.range_max}) {
    cdr_.put(value);
  }
  std::vector<float> ranges(percept.records.size() / sizeof(float));
  if (!ranges.empty()) {
    std::memcpy(ranges.data(), percept.records.data(), ranges.size() * sizeof(float));
  }
  cdr_.put_sequence(std::span<const float>(ranges));
  cdr_.put_count(0);
  return scan.paced.stream.write(file, time, cdr_.bytes());
}

Status StandardViews::command(McapWriter& file, SimTime time, const CommandRecord& command) {
  std::uint32_t kind = 0;
  double velocity[2] = {};
  // The kind, a reserved word, then the velocities.
  if (command.command.size() < 8 + sizeof velocity) return {};
  std::memcpy(&kind, command.command.data(), sizeof kind);
  const auto found = velocities_.find(command.robot);
  if (kind != kVelocityKind || found == velocities_.end() || !due(found->second, time, period_ns_))
    return {};
  std::memcpy(velocity, command.command.data() + 8, sizeof velocity);
  cdr_.clear();
  for (const double value : {velocity[0], 0.0, 0.0, 0.0, 0.0, velocity[1]}) cdr_.put(value);
  return found->second.stream.write(file, time, cdr_.bytes());
}

}  // namespace rave::record
