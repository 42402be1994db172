// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/record_keeper.hpp"

#include <array>
#include <bit>
#include <chrono>
#include <ctime>

#include "rave/control/order_words.hpp"
#include "rave/observe/event_words.hpp"

namespace rave::runtime {
namespace {

/// The wall time of the start, as text for people.
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
    recorded.is_virtual = sensors[s].virtual_ops != nullptr;
    info.sensors.push_back(std::move(recorded));
  }
}

bool same_bits(const Pose2& a, const PoseReading& b) noexcept {
  using Words = std::array<std::uint64_t, 3>;
  // By bits, because the flag that omits the second pose must not change -0 to 0 or a NaN.
  return std::bit_cast<Words>(a) == std::bit_cast<Words>(Pose2{b.x_m, b.y_m, b.yaw_rad});
}

/// Records the messages that the last step sent and delivered.
void record_radio(const sim::Engine& engine, record::RunRecorder& recorder) {
  for (const sim::RadioTrace& trace : engine.radio()) {
    recorder.radio({trace.from, trace.to, static_cast<std::uint16_t>(trace.device), trace.delivered,
                    trace.stamp_ns, trace.complete_ns, trace.payload});
  }
}

}  // namespace

RecordKeeper::RecordKeeper(record::RunRecorder recorder, const sim::Engine& engine,
                           const BodyKinds& kinds, bool hashed)
    : recorder_(std::move(recorder)), parts_(engine.spec()), kinds_(&kinds), hashed_(hashed) {
  for (std::uint32_t g = 0; g < engine.group_count(); ++g) groups_.emplace_back(engine, g);
  const sim::EngineSpec& spec = engine.spec();
  for (const sim::RobotSpec& robot : spec.robots) {
    const sim::RobotType& type = spec.types[robot.type];
    // A simulated robot without a pose source reports its true pose, so its two poses are equal and
    // it has no variances.
    told_truth_.push_back(type.simulated && !type.pose_from ? 1 : 0);
    with_real_ = with_real_ || !type.simulated;
  }
}

Result<std::unique_ptr<RecordKeeper>> RecordKeeper::open(const std::filesystem::path& path,
                                                         const sim::Engine& engine,
                                                         const BodyKinds& kinds,
                                                         const record::RunInfo& info,
                                                         const About& about, LogSink* log) {
  RAVE_TRY_ASSIGN(auto recorder, record::RunRecorder::open(path, info, {}, log));
  if (!about.hybrids.empty()) {
    RAVE_TRY(recorder.describe(record::kHybridMetadata, about.hybrids));
  }
  if (!about.host.empty()) {
    RAVE_TRY(recorder.describe(record::kHostMetadata, {{"name", about.host}}));
    RAVE_TRY(recorder.describe(record::kHostsMetadata, about.hosts));
  }
  return std::unique_ptr<RecordKeeper>(
      new RecordKeeper(std::move(recorder), engine, kinds, about.hashed));
}

void RecordKeeper::after_all(const StepView& step, std::span<RunObserver* const> all) {
  keep(step);
  keep(step.beside);
  for (const RunObserver* const observer : all) {
    keep(observer->events());
    observer->record(recorder_);
  }
}

void RecordKeeper::keep(const StepView& step) {
  const sim::Engine& engine = step.engine;
  recorder_.begin_step(engine.steps_done() - 1, engine.time());
  // First, because a hand-over in this step decides how poses and parts are recorded below.
  follow(engine);
  parts_.keep(engine, recorder_);
  for (RecordColumns& group : groups_) {
    group.keep_percepts(engine, recorder_);
    group.keep_commands(engine, recorder_);
    group.keep_actuators(engine, recorder_);
  }
  keep_poses(engine);
  variances_.keep(engine, told_truth_, recorder_);
  record_radio(engine, recorder_);
  keep(engine.events());
  // A failure is already in the log and is returned by end(); the run continues.
  if (hashed_) static_cast<void>(recorder_.hash(engine.hash().value()));
  static_cast<void>(recorder_.end_step());
}

void RecordKeeper::follow(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kHandedOver) continue;
    const sim::RobotType& type = spec.types[spec.robots[event.robot.value()].type];
    told_truth_[event.robot.value()] = type.simulated && !type.pose_from ? 1 : 0;
    with_real_ = with_real_ || !type.simulated;
    parts_.follow(spec);
  }
}

void RecordKeeper::keep_poses(const sim::Engine& engine) {
  const auto count = static_cast<std::uint32_t>(told_truth_.size());
  std::uint32_t begin = 0;
  for (std::uint32_t r = 0; r < count; ++r) {
    // A simulated robot that made way for a real one in this step was told its previous position.
    const bool in_row =
        told_truth_[r] != 0 && (!with_real_ || same_bits(engine.snapshot().robots()[r].X_WR,
                                                         engine.reported(RobotId(r)).pose));
    if (in_row) continue;
    // The robots before this one form a row, which is copied as it lies in the snapshot; this one
    // is written by itself.
    keep_row(engine, begin, r);
    keep_pose(engine, RobotId(r));
    begin = r + 1;
  }
  keep_row(engine, begin, count);
}

void RecordKeeper::keep_row(const sim::Engine& engine, std::uint32_t begin, std::uint32_t end) {
  if (begin == end) return;
  const world::RobotState& first = engine.snapshot().robots()[begin];
  recorder_.poses(
      {RobotId(begin), end - begin, &first.X_WR, &first.velocity_W, sizeof(world::RobotState)});
}

void RecordKeeper::keep_pose(const sim::Engine& engine, RobotId robot) {
  record::RobotPose pose;
  pose.robot = robot;
  pose.velocity_W = engine.snapshot().velocity_W(robot);
  const sim::EngineSpec& spec = engine.spec();
  // The true pose of a real robot is unknown.
  if (spec.types[spec.robots[robot.value()].type].simulated) {
    pose.true_pose = engine.snapshot().pose(robot);
  }
  const sim::ReportedPose& reported = engine.reported(robot);
  if (reported.known) {
    pose.reported_pose = Pose2{reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
  }
  recorder_.pose(pose);
}

void RecordKeeper::keep(const request::Request& request, std::uint64_t step) {
  RecordedWords words = recorded_words(request.action);
  static_cast<void>(recorder_.input({step, std::move(words.kind), request.robot,
                                     std::move(words.key), std::move(words.value), request.by}));
}

void record_chat(const request::Request& request, std::uint64_t step,
                 record::RunRecorder& recorder) {
  const auto* const chat = request.as<request::Chat>();
  if (chat == nullptr) return;
  static_cast<void>(recorder.chat({step, chat->number, request.by, chat->role,
                                   std::string(to_string(chat->to)), chat->name, chat->text}));
}

void RecordKeeper::say(const request::Request& chat, std::uint64_t step) {
  record_chat(chat, step, recorder_);
}

void RecordKeeper::keep(std::span<const sim::Event> events) {
  record_events(*kinds_, events, recorder_);
}

record::RunInfo info_of(const sim::Engine& engine, const BodyKinds& kinds) {
  record::RunInfo info = info_of(engine.spec(), kinds);
  for (std::uint32_t r = 0; r < info.robots.size(); ++r) {
    if (engine.is_local(RobotId(r))) describe_sensors(engine, r, info);
  }
  return info;
}

record::RunInfo info_of(const sim::EngineSpec& spec, const BodyKinds& kinds) {
  record::RunInfo info;
  info.started = utc_now();
  info.seed = spec.seed;
  info.step_s = spec.step.seconds();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    info.robots.push_back({RobotId(r), spec.robots[r].name,
                           std::string(kinds.word(kinds.body_of(RobotId(r)))),
                           spec.robots[r].team});
  }
  return info;
}

void record_events(const BodyKinds& kinds, std::span<const sim::Event> events,
                   record::RunRecorder& recorder) {
  for (const sim::Event& event : events) {
    record::RunEvent recorded;
    recorded.robot = event.robot;
    recorded.kind = to_string(event.kind);
    recorded.text = words_of(kinds, event);
    // The names of obstacles may be used again; their numbers are unique.
    if (is_of_obstacle(event.kind)) {
      recorded.values.push_back(static_cast<double>(event.other.value()));
      if (event.detail != 0) recorded.values.push_back(static_cast<double>(event.detail));
    }
    static_cast<void>(recorder.event(recorded));
  }
}

}  // namespace rave::runtime
