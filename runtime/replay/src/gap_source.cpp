// SPDX-License-Identifier: Apache-2.0
#include "gap_source.hpp"

#include <algorithm>
#include <cstring>

#include "rave/base/names.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/reading.hpp"

namespace rave::runtime {
namespace {

/// A driver that takes commands but executes none.
constexpr std::string_view kDeaf = "replay_ignored";

Pose2 pose_of(const config::PoseFile& file) {
  return {file.x_m, file.y_m, wrap_angle(deg_to_rad(file.yaw_deg))};
}

// Records are bytes of a file and may be unaligned, so they are copied.
template <class Reading>
std::optional<Reading> reading_of(std::span<const std::byte> records) {
  if (records.size() < sizeof(Reading)) return std::nullopt;
  Reading reading;
  std::memcpy(&reading, records.data(), sizeof reading);
  return reading;
}

/// The track from the sensor that the robot file names; its samples have their own stamps.
Result<GapTrack> track_of_sensor(const GapSource& source, const record::RecordedSensor& sensor,
                                 const Pose2& X_WM) {
  RAVE_TRY_ASSIGN(const auto all,
                  record::read_samples(source.reader, source.robot.id, sensor.sensor,
                                       record::PerceptPart::kResult));
  GapTrack track;
  for (const auto& sample : all.samples) {
    const auto records = all.records_of(sample);
    Pose2 X_MR;
    if (static_cast<ReadingKind>(sensor.kind) == ReadingKind::kPose) {
      const auto reading = reading_of<PoseReading>(records);
      if (!reading) continue;
      X_MR = {reading->x_m, reading->y_m, reading->yaw_rad};
    } else {
      const auto reading = reading_of<OdometryReading>(records);
      if (!reading) continue;
      X_MR = {reading->x_m, reading->y_m, reading->yaw_rad};
    }
    track.add({sample.header.stamp_ns}, compose(X_WM, X_MR));
  }
  return track;
}

/// The frame of the pose source, as the engine uses it; empty if it is unknown.
std::optional<Pose2> frame_of(const GapSource& source, const record::RecordedSensor& sensor) {
  const config::PoseFile& frame = source.file().source_frame;
  if (frame != config::PoseFile{}) return pose_of(frame);
  // A pose without a frame of its own is one of the world. Odometry begins at the start pose of the
  // robot, if the scenario states it.
  if (static_cast<ReadingKind>(sensor.kind) == ReadingKind::kPose) return Pose2{};
  if (source.expanded().pose) return pose_of(*source.expanded().pose);
  return std::nullopt;
}

std::vector<std::string_view> velocity_sensors(const GapSource& source) {
  std::vector<std::string_view> names;
  for (const record::RecordedSensor& sensor : source.run.sensors) {
    if (sensor.robot == source.robot.id &&
        static_cast<ReadingKind>(sensor.kind) == ReadingKind::kVelocity) {
      names.push_back(sensor.name);
    }
  }
  return names;
}

Result<GapCommands> commands_of_sensor(const GapSource& source, const std::string& name) {
  RAVE_TRY_ASSIGN(const auto* const sensor, record::find_sensor(source.run, source.robot, name));
  if (static_cast<ReadingKind>(sensor->kind) != ReadingKind::kVelocity) {
    return fail(ErrorCode::kInvalidArgument,
                "sensor `{}` gives {}; commands are velocities, which these sensors give: {}", name,
                to_string(static_cast<ReadingKind>(sensor->kind)),
                join_names(velocity_sensors(source)));
  }
  RAVE_TRY_ASSIGN(const auto all,
                  record::read_samples(source.reader, source.robot.id, sensor->sensor,
                                       record::PerceptPart::kResult));
  GapCommands commands;
  commands.source = fmt::format("sensor `{}`", name);
  for (const auto& sample : all.samples) {
    const auto reading = reading_of<VelocityReading>(all.records_of(sample));
    if (!reading) continue;
    commands.commands.push_back(
        {{sample.header.stamp_ns}, velocity_command(reading->v_mps, reading->w_radps)});
  }
  if (!commands.commands.empty()) return commands;
  return fail(ErrorCode::kInvalidArgument, "sensor `{}` gave no velocities in the recording", name);
}

std::string hint(const GapSource& source) {
  const auto names = velocity_sensors(source);
  return names.empty()
             ? ""
             : fmt::format("; --commands takes one of its sensors: {}", join_names(names));
}

Result<GapCommands> commands_of_actuator(const GapSource& source, CommandKind kind) {
  GapCommands commands;
  commands.source = "what reached the actuator";
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, record::decode_actuators(message.bytes));
    for (const record::ActuatorRecord& item : step.items) {
      const auto command = reading_of<Command>(item.command);
      if (item.robot != source.robot.id || !command) continue;
      // `none` counts as well: the actuator had no command then, and the twin must have none,
      // either.
      const bool fits = command->kind == kind || command->kind == CommandKind::kNone;
      if (fits) commands.commands.push_back({step.time, *command});
    }
    return {};
  };
  RAVE_TRY(record::for_each_message(source.reader, record::topic::kActuators, take));
  return commands;
}

/// For old recordings without the commands to actuators: the commands of the program.
Result<GapCommands> commands_of_program(const GapSource& source, CommandKind kind) {
  GapCommands commands;
  commands.source = "what the program asked for";
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, record::decode_commands(message.bytes));
    for (const record::CommandRecord& item : step.items) {
      const auto command = reading_of<Command>(item.command);
      if (item.robot != source.robot.id || !command || command->kind != kind) continue;
      commands.commands.push_back({step.time, *command});
    }
    return {};
  };
  RAVE_TRY(record::for_each_message(source.reader, record::topic::kCommands, take));
  return commands;
}

}  // namespace

void GapTrack::add(SimTime time, const Pose2& X_WR) {
  // Samples are read in the order of the recording. Of two with one stamp the later one counts;
  // older ones are dropped.
  if (!points_.empty() && time <= points_.back().time) {
    if (time == points_.back().time) points_.back().X_WR = X_WR;
    return;
  }
  points_.push_back({time, X_WR});
}

std::optional<Pose2> GapTrack::at(SimTime time) const {
  const auto after = std::ranges::lower_bound(points_, time, {}, &Point::time);
  if (after == points_.end()) return std::nullopt;
  if (after->time == time) return after->X_WR;
  if (after == points_.begin()) return std::nullopt;
  const Point& before = *(after - 1);
  // Across a long gap a straight line says nothing about where the robot was.
  const Duration between = after->time - before.time;
  if (between > kLongestGap) return std::nullopt;
  return interpolate(
      before.X_WR, after->X_WR,
      static_cast<double>((time - before.time).ns) / static_cast<double>(between.ns));
}

Command GapCommands::at(SimTime time) const {
  const auto after = std::ranges::upper_bound(commands, time, {}, &At::time);
  // A command holds until the next one. Before the first one there is none, and the twin stands.
  return after == commands.begin() ? Command{} : (after - 1)->command;
}

Result<GapTrack> read_track(const GapSource& source, bool truth, std::string& from) {
  const auto& pose_from = source.file().pose_from;
  if (!truth && pose_from) {
    RAVE_TRY_ASSIGN(const auto* const sensor,
                    record::find_sensor(source.run, source.robot, pose_from->value));
    // The samples of the sensor are preferred: they have the time of the measurement. The recorded
    // poses have the times of steps.
    if (const auto X_WM = frame_of(source, *sensor)) {
      RAVE_TRY_ASSIGN(GapTrack track, track_of_sensor(source, *sensor, *X_WM));
      from = fmt::format("sensor `{}`", sensor->name);
      if (!track.empty()) return track;
    }
  }
  RAVE_TRY_ASSIGN(const auto poses, record::read_poses(source.reader, source.robot.id));
  GapTrack track;
  from = truth ? "true pose" : "reported pose";
  for (const record::PoseTrackPoint& point : poses) {
    const auto& pose = truth ? point.true_pose : point.reported_pose;
    if (pose) track.add(point.time, *pose);
  }
  if (track.empty()) {
    return fail(ErrorCode::kInvalidArgument, "robot `{}` has no {} in the recording",
                source.robot.name, from);
  }
  return track;
}

Result<GapCommands> read_commands(const GapSource& source, const std::string& sensor,
                                  CommandKind kind) {
  if (!sensor.empty()) {
    if (kind != CommandKind::kVelocity) {
      return fail(ErrorCode::kInvalidArgument, "the twin takes {}, and a sensor gives velocities",
                  to_string(kind));
    }
    return commands_of_sensor(source, sensor);
  }
  // Such a robot did not execute the commands that are in the recording.
  for (const config::ActuatorFile& actuator : source.file().actuators) {
    if (actuator.driver.value != kDeaf) continue;
    return fail(ErrorCode::kInvalidArgument,
                "robot `{}` is a recorded robot, which ignored its commands{}", source.robot.name,
                hint(source));
  }
  const bool recorded = source.reader.channel(record::topic::kActuators) != nullptr;
  RAVE_TRY_ASSIGN(GapCommands commands, recorded ? commands_of_actuator(source, kind)
                                                 : commands_of_program(source, kind));
  if (!commands.commands.empty()) return commands;
  return fail(ErrorCode::kInvalidArgument, "the recording has no {} commands of robot `{}`{}",
              to_string(kind), source.robot.name, hint(source));
}

}  // namespace rave::runtime
