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

/// Reads the common beginning of messages with arrays of a version.
template <class Item>
[[nodiscard]] Status take_head(CdrReader& reader, const char* topic, StepOf<Item>& step) {
  step.time = get_time(reader);
  step.step = reader.get<std::uint64_t>();
  const auto version = reader.get<std::uint32_t>();
  // What follows has the layout of the version, so nothing of another one can be read.
  if (!reader.ok() || version == kLayoutVersion) return {};
  return fail(ErrorCode::kParse,
              "a message of `{}` has layout {}; this RAVE reads layout {}, so another version of "
              "RAVE wrote the recording",
              topic, version, kLayoutVersion);
}

template <class Packed>
[[nodiscard]] std::vector<Packed> get_array(CdrReader& reader) {
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
  RAVE_TRY(take_head(reader, topic, step));
  const auto packed = get_array<Packed>(reader);
  const Message records = reader.get_bytes();
  if (!reader.ok() || !add_items(packed, records, make, step.items)) return malformed(topic);
  return step;
}

/// Reads what encode() has written.
template <class... T>
[[nodiscard]] Status decode(Message message, const char* topic, SimTime& time, T&... values) {
  CdrReader reader(message);
  time = get_time(reader);
  CdrTake<RunMembers>{reader}(values...);
  return reader.ok() ? Status() : malformed(topic);
}

/// Reads a message of one item.
template <class Item>
[[nodiscard]] Result<StepOf<Item>> decode_one(Message message, const char* topic) {
  StepOf<Item> step;
  RAVE_TRY(decode(message, topic, step.time, step.step, step.items.emplace_back()));
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
  RAVE_TRY(take_head(reader, topic::kPoses, step));
  const auto packed = get_array<PackedPose>(reader);
  // Aligns the second array to 8.
  static_cast<void>(reader.get<std::uint32_t>());
  const auto truths = get_array<PackedTruePose>(reader);
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
  RAVE_TRY(take_head(reader, topic::kVariances, step));
  CdrTake<RunMembers>{reader}(step.items);
  if (!reader.ok()) return malformed(topic::kVariances);
  return step;
}

Result<StepOf<RunEvent>> decode_event(Message message) {
  return decode_one<RunEvent>(message, topic::kEvents);
}

Result<StepOf<ShadowRecord>> decode_shadow(Message message) {
  return decode_one<ShadowRecord>(message, topic::kShadows);
}

Result<RunInput> decode_input(Message message) {
  SimTime time;
  RunInput input;
  RAVE_TRY(decode(message, topic::kInputs, time, input));
  return input;
}

Result<std::pair<SimTime, RunChat>> decode_chat(Message message) {
  std::pair<SimTime, RunChat> said;
  RAVE_TRY(decode(message, topic::kChat, said.first, said.second));
  return said;
}

Result<ConsoleLine> decode_console(Message message) {
  ConsoleLine line;
  std::uint8_t level = 0;
  RAVE_TRY(decode(message, topic::kConsole, line.time, level, line.source, line.text));
  if (level < 10 || level > 50) return malformed(topic::kConsole);
  line.level = level >= 40   ? LogLevel::kError
               : level >= 30 ? LogLevel::kWarning
               : level >= 20 ? LogLevel::kInfo
                             : LogLevel::kDebug;
  return line;
}

Result<StepHash> decode_hash(Message message) {
  StepHash hash;
  RAVE_TRY(decode(message, topic::kHash, hash.time, hash.step, hash.hash));
  return hash;
}

Result<RunEnd> decode_end(Message message) {
  RunEnd end;
  bool has_hash = false;
  std::uint64_t hash = 0;
  RAVE_TRY(decode(message, topic::kEnd, end.time, end.steps, has_hash, hash));
  if (has_hash) end.hash = hash;
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
