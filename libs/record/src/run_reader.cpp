// SPDX-License-Identifier: Apache-2.0
// What a recording says of its run, and the samples and poses of one robot.
#include "rave/record/run_reader.hpp"

#include <algorithm>
#include <type_traits>

#include "rave/base/names.hpp"

namespace rave::record {
namespace {

/// The first message of a topic, decoded; empty if it is missing or damaged.
template <class Decode>
auto first_of(const McapReader& reader, const char* topic, Decode decode) -> std::optional<
    typename std::invoke_result_t<Decode, std::span<const std::byte>>::value_type> {
  const ChannelInfo* channel = reader.channel(topic);
  if (channel == nullptr) return std::nullopt;
  MessageCursor cursor = reader.messages({{channel->id}});
  const auto message = cursor.next();
  if (!message || !*message) return std::nullopt;
  auto decoded = decode((*message)->bytes);
  if (!decoded) return std::nullopt;
  return *std::move(decoded);
}

tl::unexpected<Error> unknown(std::string_view what, std::string_view name, std::string_view where,
                              const std::vector<std::string_view>& names) {
  return fail(ErrorCode::kNotFound, "{} has no {} `{}`{}", where, what, name,
              suggestion(name, names));
}

}  // namespace

Result<RunInfo> read_run_info(const McapReader& reader) {
  auto run = first_of(reader, topic::kRun, decode_run);
  if (!run) {
    return fail(ErrorCode::kParse,
                "the recording does not describe its run: RAVE did not write it, or its beginning "
                "is damaged");
  }
  const auto& attachments = reader.attachments();
  const auto yaml = std::ranges::find(attachments, "scenario.yaml", &AttachmentInfo::name);
  if (yaml != attachments.end()) {
    // A recording without its scenario can still be looked at, only not replayed.
    if (auto text = reader.read_attachment(*yaml)) run->expanded_scenario = *std::move(text);
  }
  run->inputs = reader.metadata_named("rave.inputs");
  return *std::move(run);
}

std::optional<RunEnd> read_run_end(const McapReader& reader) {
  return first_of(reader, topic::kEnd, decode_end);
}

Result<const RecordedRobot*> find_robot(const RunInfo& run, std::string_view name) {
  const auto found = std::ranges::find(run.robots, name, &RecordedRobot::name);
  if (found != run.robots.end()) return &*found;
  std::vector<std::string_view> names;
  for (const RecordedRobot& robot : run.robots) names.push_back(robot.name);
  return unknown("robot", name, "the recording", names);
}

Result<const RecordedSensor*> find_sensor(const RunInfo& run, const RecordedRobot& robot,
                                          std::string_view name) {
  std::vector<std::string_view> names;
  for (const RecordedSensor& sensor : run.sensors) {
    if (sensor.robot != robot.id) continue;
    if (sensor.name == name) return &sensor;
    names.push_back(sensor.name);
  }
  return unknown("sensor", name, fmt::format("robot `{}` of the recording", robot.name), names);
}

Result<SensorSamples> read_samples(const McapReader& reader, RobotId robot, DeviceId sensor,
                                   PerceptPart part) {
  SensorSamples all;
  RAVE_TRY(for_each_message(reader, topic::kPercepts, [&](const MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, decode_percepts(message.bytes));
    for (const Percept& percept : step.items) {
      if (percept.robot != robot || percept.sensor != sensor || percept.part != part) continue;
      all.samples.push_back(
          {step.time, percept.header, all.records.size(), percept.records.size()});
      all.records.insert(all.records.end(), percept.records.begin(), percept.records.end());
    }
    return {};
  }));
  return all;
}

Result<std::vector<PoseTrackPoint>> read_poses(const McapReader& reader, RobotId robot) {
  std::vector<PoseTrackPoint> track;
  RAVE_TRY(for_each_message(reader, topic::kPoses, [&](const MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, decode_poses(message.bytes));
    for (const RobotPose& pose : step.items) {
      if (pose.robot != robot) continue;
      track.push_back({step.time, pose.true_pose, pose.reported_pose});
    }
    return {};
  }));
  return track;
}

}  // namespace rave::record
