// SPDX-License-Identifier: Apache-2.0
// From bytes of a recording to values. The bytes may be damaged or from another program, so every
// count and offset is checked against the bytes that are there.
#include "cdr_time.hpp"
#include "packed.hpp"
#include "rave/record/run_messages.hpp"
#include "run_members.hpp"

namespace rave::record {
namespace {

using Message = std::span<const std::byte>;

tl::unexpected<Error> malformed(const char* topic) {
  return fail(ErrorCode::kParse, "a message of `{}` does not have the format that RAVE writes",
              topic);
}

tl::unexpected<Error> other_version(const char* topic, std::uint32_t version) {
  return fail(ErrorCode::kParse,
              "a message of `{}` has layout {}; this RAVE reads layout {}, so another version of "
              "RAVE wrote the recording",
              topic, version, kLayoutVersion);
}

/// Reads the common beginning of messages with packed arrays, and the first array.
template <class Packed, class Item>
[[nodiscard]] std::vector<Packed> get_step(CdrReader& reader, StepOf<Item>& step,
                                           std::uint32_t& version) {
  step.time = get_time(reader);
  step.step = reader.get<std::uint64_t>();
  version = reader.get<std::uint32_t>();
  // What follows has the layout of the version, so nothing of another one can be read.
  if (version != kLayoutVersion) return {};
  return reader.get_packed<Packed>(reader.get<std::uint32_t>());
}

/// The number of robots that an element represents.
template <class Packed>
[[nodiscard]] std::uint32_t robots_of(const Packed& element) noexcept {
  if constexpr (requires { element.robots; }) {
    return element.robots;
  } else {
    return 1;
  }
}

/// Assigns each robot of each element its part of the common bytes; false if a part exceeds them,
/// or if a row cannot be divided equally.
template <class Packed, class Item, class Make>
[[nodiscard]] bool add_items(const std::vector<Packed>& packed, Message records, Make make,
                             std::vector<Item>& items) {
  items.reserve(packed.size());
  for (const Packed& element : packed) {
    if (element.offset > records.size() || element.size > records.size() - element.offset) {
      return false;
    }
    const std::uint32_t robots = robots_of(element);
    if (robots == 0 || element.size % robots != 0) return false;
    const std::uint32_t size = element.size / robots;
    // The available bytes bound the number of robots that a damaged message can claim.
    if (robots > 1 && size == 0) return false;
    for (std::uint32_t i = 0; i < robots; ++i) {
      items.push_back(make(element, i, records.subspan(element.offset + i * size, size)));
    }
  }
  return true;
}

template <class Packed, class Item, class Make>
[[nodiscard]] Result<StepOf<Item>> decode_step(Message message, const char* topic, Make make) {
  CdrReader reader(message);
  StepOf<Item> step;
  std::uint32_t version = 0;
  const auto packed = get_step<Packed>(reader, step, version);
  if (reader.ok() && version != kLayoutVersion) return other_version(topic, version);
  const Message records = reader.get_bytes();
  if (!reader.ok() || !add_items(packed, records, make, step.items)) return malformed(topic);
  return step;
}

/// Reads a message of one item.
template <class Item>
[[nodiscard]] Result<StepOf<Item>> decode_one(Message message, const char* topic) {
  CdrReader reader(message);
  StepOf<Item> step;
  step.time = get_time(reader);
  CdrTake<RunMembers>{reader}(step.step, step.items.emplace_back());
  if (!reader.ok()) return malformed(topic);
  return step;
}

}  // namespace

Result<StepOf<Percept>> decode_percepts(Message message) {
  return decode_step<PackedPercept, Percept>(
      message, topic::kPercepts, [](const PackedPercept& p, std::uint32_t i, Message records) {
        return Percept{RobotId(p.robot + i),
                       DeviceId(p.sensor),
                       p.kind,
                       static_cast<PerceptPart>(p.part),
                       {p.stamp_ns, p.sequence, p.count, p.fresh, p.dropped},
                       records};
      });
}

Result<StepOf<CommandRecord>> decode_commands(Message message) {
  return decode_step<PackedCommand, CommandRecord>(
      message, topic::kCommands, [](const PackedCommand& c, std::uint32_t i, Message records) {
        return CommandRecord{RobotId(c.robot + i), DeviceId(c.controller), records};
      });
}

Result<StepOf<ActuatorRecord>> decode_actuators(Message message) {
  return decode_step<PackedActuator, ActuatorRecord>(
      message, topic::kActuators, [](const PackedActuator& c, std::uint32_t, Message records) {
        return ActuatorRecord{RobotId(c.robot), DeviceId(c.actuator), records};
      });
}

Result<StepOf<RadioPacket>> decode_radio(Message message) {
  return decode_step<PackedPacket, RadioPacket>(
      message, topic::kRadio, [](const PackedPacket& p, std::uint32_t, Message records) {
        return RadioPacket{RobotId(p.from), RobotId(p.to), p.transmitter, p.delivered != 0,
                           p.sent_ns,       p.received_ns, records};
      });
}

Result<StepOf<RobotPose>> decode_poses(Message message) {
  CdrReader reader(message);
  StepOf<RobotPose> step;
  std::uint32_t version = 0;
  const auto packed = get_step<PackedPose>(reader, step, version);
  if (reader.ok() && version != kLayoutVersion) return other_version(topic::kPoses, version);
  // Aligns the second array to 8.
  static_cast<void>(reader.get<std::uint32_t>());
  const auto truths = reader.get_packed<PackedTruePose>(reader.get<std::uint32_t>());
  if (!reader.ok()) return malformed(topic::kPoses);
  // True poses are few: only of robots whose reported pose differs. They are in the order of the
  // robots.
  auto truth = truths.begin();
  step.items.reserve(packed.size());
  for (const PackedPose& p : packed) {
    RobotPose pose;
    pose.robot = RobotId(p.robot);
    pose.velocity_W = {p.vx, p.vy, p.wz};
    if ((p.flags & kHasReported) != 0) pose.reported_pose = Pose2{p.x, p.y, p.yaw};
    if ((p.flags & kTrueIsReported) != 0) {
      pose.true_pose = Pose2{p.x, p.y, p.yaw};
    } else if ((p.flags & kHasTrue) != 0) {
      if (truth == truths.end() || truth->robot != p.robot) return malformed(topic::kPoses);
      pose.true_pose = Pose2{truth->x, truth->y, truth->yaw};
      ++truth;
    }
    step.items.push_back(pose);
  }
  return step;
}

Result<StepOf<PoseVariance>> decode_variances(Message message) {
  CdrReader reader(message);
  StepOf<PoseVariance> step;
  std::uint32_t version = 0;
  const auto packed = get_step<PackedVariance>(reader, step, version);
  if (reader.ok() && version != kLayoutVersion) return other_version(topic::kVariances, version);
  if (!reader.ok()) return malformed(topic::kVariances);
  step.items.reserve(packed.size());
  for (const PackedVariance& robot : packed) {
    step.items.push_back({RobotId(robot.robot), robot.xy_m2, robot.yaw_rad2});
  }
  return step;
}

Result<StepOf<RunEvent>> decode_event(Message message) {
  return decode_one<RunEvent>(message, topic::kEvents);
}

Result<StepOf<ShadowRecord>> decode_shadow(Message message) {
  return decode_one<ShadowRecord>(message, topic::kShadows);
}

Result<RunInput> decode_input(Message message) {
  CdrReader reader(message);
  static_cast<void>(get_time(reader));
  RunInput input;
  CdrTake<RunMembers>{reader}(input);
  if (!reader.ok()) return malformed(topic::kInputs);
  return input;
}

Result<std::pair<SimTime, RunChat>> decode_chat(Message message) {
  CdrReader reader(message);
  std::pair<SimTime, RunChat> said;
  said.first = get_time(reader);
  CdrTake<RunMembers>{reader}(said.second);
  if (!reader.ok()) return malformed(topic::kChat);
  return said;
}

Result<ConsoleLine> decode_console(Message message) {
  CdrReader reader(message);
  ConsoleLine line;
  line.time = get_time(reader);
  const auto level = reader.get<std::uint8_t>();
  line.source = reader.get_string();
  line.text = reader.get_string();
  if (!reader.ok() || level < 10 || level > 50) return malformed(topic::kConsole);
  line.level = level >= 40   ? LogLevel::kError
               : level >= 30 ? LogLevel::kWarning
               : level >= 20 ? LogLevel::kInfo
                             : LogLevel::kDebug;
  return line;
}

Result<StepHash> decode_hash(Message message) {
  CdrReader reader(message);
  StepHash hash;
  hash.time = get_time(reader);
  hash.step = reader.get<std::uint64_t>();
  hash.hash = reader.get<std::uint64_t>();
  if (!reader.ok()) return malformed(topic::kHash);
  return hash;
}

Result<RunEnd> decode_end(Message message) {
  CdrReader reader(message);
  RunEnd end;
  end.time = get_time(reader);
  end.steps = reader.get<std::uint64_t>();
  const bool has_hash = reader.get<std::uint8_t>() != 0;
  const auto hash = reader.get<std::uint64_t>();
  if (has_hash) end.hash = hash;
  if (!reader.ok()) return malformed(topic::kEnd);
  return end;
}

Result<RunInfo> decode_run(Message message) {
  CdrReader reader(message);
  RunInfo info;
  CdrTake<RunMembers>{reader}(info);
  if (!reader.ok()) return malformed(topic::kRun);
  return info;
}

}  // namespace rave::record
