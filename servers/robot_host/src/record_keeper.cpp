// SPDX-License-Identifier: Apache-2.0
#include "record_keeper.hpp"

#include <chrono>
#include <ctime>

namespace rave::robot_host {
namespace {

/// The wall time of the start, for people.
std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm broken_down{};
  ::gmtime_r(&now, &broken_down);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &broken_down);
  return text;
}

void describe_sensors(const sim::Engine& engine, std::uint32_t robot, record::RunInfo& info) {
  const sim::EngineSpec& spec = engine.spec();
  const auto& sensors = spec.types[spec.robots[robot].type].sensors;
  for (std::uint32_t s = 0; s < sensors.size(); ++s) {
    const SensorInfo& sensor = *engine.sensor(RobotId(robot), s).info;
    record::RecordedSensor recorded;
    recorded.robot = RobotId(robot);
    recorded.sensor = DeviceId(s);
    recorded.name = sensor.name;
    recorded.kind = static_cast<std::uint32_t>(sensor.kind);
    recorded.X_RS = sensor.X_RS;
    recorded.z_m = sensor.z_m;
    recorded.period_s = sensor.period_s;
    recorded.range_min_m = sensor.range_min_m;
    recorded.range_max_m = sensor.range_max_m;
    recorded.cone_rad = sensor.cone_rad;
    if (sensor.bearings_rad != nullptr) {
      recorded.bearings_rad.assign(sensor.bearings_rad, sensor.bearings_rad + sensor.capacity);
    }
    info.sensors.push_back(std::move(recorded));
  }
}

}  // namespace

RecordKeeper::RecordKeeper(record::RunRecorder recorder, const sim::EngineSpec& spec,
                           const BodyKinds& kinds)
    : recorder_(std::move(recorder)), kinds_(&kinds) {
  for (const sim::RobotSpec& robot : spec.robots) {
    seen_.emplace_back(spec.types[robot.type].sensors.size());
  }
}

Result<std::unique_ptr<RecordKeeper>> RecordKeeper::begin(
    const std::filesystem::path& path, const sim::Engine& engine, const BodyKinds& kinds,
    const std::string& scenario_name, const std::string& expanded_scenario, LogSink* log) {
  const sim::EngineSpec& spec = engine.spec();
  record::RunInfo info;
  info.scenario = scenario_name;
  info.started = utc_now();
  info.seed = spec.seed;
  info.step_s = spec.step.seconds();
  info.expanded_scenario = expanded_scenario;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    info.robots.push_back({RobotId(r), spec.robots[r].name,
                           std::string(kinds.word(kinds.body_of(RobotId(r)))),
                           spec.robots[r].team});
    describe_sensors(engine, r, info);
  }
  RAVE_TRY_ASSIGN(auto recorder, record::RunRecorder::open(path, info, {}, log));
  return std::unique_ptr<RecordKeeper>(new RecordKeeper(std::move(recorder), spec, kinds));
}

void RecordKeeper::after_step(sim::Engine& engine) {
  recorder_.begin_step(engine.steps_done() - 1, engine.time());
  poses_.clear();
  for (std::uint32_t r = 0; r < seen_.size(); ++r) keep_robot(engine, r);
  keep(engine.events());
  // A failure was told to the log when it happened, and end() returns it: the run goes on.
  static_cast<void>(recorder_.poses(poses_));
  static_cast<void>(recorder_.end_step());
}

void RecordKeeper::keep_robot(const sim::Engine& engine, std::uint32_t robot) {
  const RobotId id(robot);
  const sim::EngineSpec& spec = engine.spec();
  const sim::RobotType& type = spec.types[spec.robots[robot].type];
  for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
    const sim::SensorSample sample = engine.sensor(id, s);
    const SampleHeader& header = *sample.header;
    if (header.sequence == seen_[robot][s]) continue;
    seen_[robot][s] = header.sequence;
    const std::size_t bytes = std::size_t{header.count} * record_size(type.sensors[s].kind);
    recorder_.percept({id,
                       DeviceId(s),
                       static_cast<std::uint8_t>(type.sensors[s].kind),
                       record::PerceptPart::kResult,
                       {header.stamp_ns, header.sequence, header.count, 1, header.dropped},
                       {static_cast<const std::byte*>(sample.records), bytes}});
  }
  for (std::uint32_t c = 0; c < type.controllers.size(); ++c) {
    if (engine.command_step(id, c) + 1 != static_cast<std::int64_t>(engine.steps_done())) continue;
    const Command command = engine.command(id, c);
    recorder_.command({id, DeviceId(c), std::as_bytes(std::span(&command, 1))});
  }
  record::RobotPose pose;
  pose.robot = id;
  pose.velocity_W = engine.snapshot().velocity_W(id);
  if (type.simulated) pose.true_pose = engine.snapshot().pose(id);
  const sim::ReportedPose& reported = engine.reported(id);
  if (reported.known) {
    pose.reported_pose = Pose2{reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
  }
  poses_.push_back(pose);
}

void RecordKeeper::keep(std::span<const sim::Event> events) {
  for (const sim::Event& event : events) {
    record::RunEvent recorded;
    recorded.robot = event.robot;
    recorded.kind = to_string(event.kind);
    recorded.text = event.other.valid()
                        ? fmt::format("with {} {}", kinds_->name(event.other.value()), event.text)
                        : event.text;
    static_cast<void>(recorder_.event(recorded));
  }
}

}  // namespace rave::robot_host
