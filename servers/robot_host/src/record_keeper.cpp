// SPDX-License-Identifier: Apache-2.0
#include "record_keeper.hpp"

#include <array>
#include <bit>
#include <chrono>
#include <ctime>

#include "radio_report.hpp"

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

RecordKeeper::RecordKeeper(record::RunRecorder recorder, const sim::Engine& engine,
                           const BodyKinds& kinds, bool hashed)
    : recorder_(std::move(recorder)), parts_(engine.spec()), kinds_(&kinds), hashed_(hashed) {
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    const sim::RobotType& type = spec.types[spec.robots[r].type];
    for (std::uint32_t s = 0; s < type.sensors.size(); ++s) {
      const sim::SensorSample sample = engine.sensor(RobotId(r), s);
      const ReadingKind kind = type.sensors[s].kind;
      sensors_.push_back({sample.header, static_cast<const std::byte*>(sample.records), s,
                          record_size(kind), 0, static_cast<std::uint8_t>(kind)});
    }
    for (std::uint32_t a = 0; a < type.actuators.size(); ++a) {
      actuators_.push_back({&engine.actuator_command(RobotId(r), a), {}});
    }
    robots_.push_back({static_cast<std::uint32_t>(sensors_.size()),
                       static_cast<std::uint32_t>(actuators_.size()),
                       static_cast<std::uint32_t>(type.controllers.size()), type.simulated});
  }
}

Result<std::unique_ptr<RecordKeeper>> RecordKeeper::begin(const std::filesystem::path& path,
                                                          const sim::Engine& engine,
                                                          const BodyKinds& kinds,
                                                          const About& about, LogSink* log) {
  const sim::EngineSpec& spec = engine.spec();
  record::RunInfo info;
  info.scenario = about.scenario;
  info.started = utc_now();
  info.seed = spec.seed;
  info.step_s = spec.step.seconds();
  info.expanded_scenario = about.expanded;
  info.versions = about.versions;
  info.inputs = about.inputs;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    info.robots.push_back({RobotId(r), spec.robots[r].name,
                           std::string(kinds.word(kinds.body_of(RobotId(r)))),
                           spec.robots[r].team});
    describe_sensors(engine, r, info);
  }
  RAVE_TRY_ASSIGN(auto recorder, record::RunRecorder::open(path, info, {}, log));
  RAVE_TRY(PartKeeper::describe(spec, recorder));
  return std::unique_ptr<RecordKeeper>(
      new RecordKeeper(std::move(recorder), engine, kinds, about.hashed));
}

void RecordKeeper::after_step(sim::Engine& engine) {
  recorder_.begin_step(engine.steps_done() - 1, engine.time());
  parts_.keep(engine, recorder_);
  std::uint32_t sensor = 0;
  std::uint32_t actuator = 0;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    const Robot& robot = robots_[r];
    keep_sensors(RobotId(r), sensor, robot.sensors_end);
    keep_commands(engine, RobotId(r), robot.controllers);
    keep_actuators(RobotId(r), actuator, robot.actuators_end);
    keep_pose(engine, RobotId(r), robot.simulated);
    sensor = robot.sensors_end;
    actuator = robot.actuators_end;
  }
  record_radio(engine, recorder_);
  keep(engine.events());
  // A failure was told to the log when it happened, and end() returns it: the run goes on.
  if (hashed_) static_cast<void>(recorder_.hash(engine.hash().value()));
  static_cast<void>(recorder_.end_step());
}

void RecordKeeper::keep_sensors(RobotId robot, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    Sensor& sensor = sensors_[i];
    const SampleHeader& header = *sensor.header;
    if (header.sequence == sensor.seen) continue;
    sensor.seen = header.sequence;
    recorder_.percept({robot,
                       DeviceId(sensor.device),
                       sensor.kind,
                       record::PerceptPart::kResult,
                       {header.stamp_ns, header.sequence, header.count, 1, header.dropped},
                       {sensor.records, std::size_t{header.count} * sensor.record_bytes}});
  }
}

void RecordKeeper::keep_commands(const sim::Engine& engine, RobotId robot,
                                 std::uint32_t controllers) {
  for (std::uint32_t c = 0; c < controllers; ++c) {
    if (engine.command_step(robot, c) + 1 != static_cast<std::int64_t>(engine.steps_done())) {
      continue;
    }
    const Command command = engine.command(robot, c);
    recorder_.command({robot, DeviceId(c), std::as_bytes(std::span(&command, 1))});
  }
}

void RecordKeeper::keep_actuators(RobotId robot, std::uint32_t begin, std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    Actuator& actuator = actuators_[i];
    // By bits: -0 is another command than 0.
    using Words = std::array<std::uint64_t, 5>;
    if (std::bit_cast<Words>(*actuator.command) == std::bit_cast<Words>(actuator.told)) continue;
    actuator.told = *actuator.command;
    recorder_.actuator({robot, DeviceId(i - begin), std::as_bytes(std::span(&actuator.told, 1))});
  }
}

void RecordKeeper::keep_pose(const sim::Engine& engine, RobotId robot, bool simulated) {
  record::RobotPose pose;
  pose.robot = robot;
  pose.velocity_W = engine.snapshot().velocity_W(robot);
  if (simulated) pose.true_pose = engine.snapshot().pose(robot);
  const sim::ReportedPose& reported = engine.reported(robot);
  if (reported.known) {
    pose.reported_pose = Pose2{reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
  }
  recorder_.pose(pose);
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
