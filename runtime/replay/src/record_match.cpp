// SPDX-License-Identifier: Apache-2.0
#include "record_match.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <vector>

#include "rave/record/moment_cursor.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/reading_type.hpp"
#include "rave/sim/event.hpp"

namespace rave::runtime {
// Two recordings are compared message by message as bytes, which is fast. Only where bytes differ
// are the messages decoded, to name the robot and channel, or to find that a merged recording has
// the same items in another order.
namespace {

using Bytes = std::vector<std::byte>;
using ByteSpan = std::span<const std::byte>;

/// In the order of cause and effect within a step.
constexpr std::array kTopics = {record::topic::kPoses,     record::topic::kPercepts,
                                record::topic::kRadio,     record::topic::kCommands,
                                record::topic::kActuators, record::topic::kEvents,
                                record::topic::kHash};

/// One item of a step: its robot and its bits.
struct Item {
  std::uint32_t robot = RobotId::kNone;
  std::string channel;
  Bytes bits;
  std::string text;
};

template <class T>
void append(Bytes& bits, const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  bits.insert(bits.end(), bytes.begin(), bytes.end());
}

std::string pose_text(const std::optional<Pose2>& pose) {
  return pose ? fmt::format("({}, {}, {})", pose->x, pose->y, pose->yaw) : "none";
}

std::string sensor_name(const record::RunInfo& run, RobotId robot, DeviceId sensor) {
  for (const record::RecordedSensor& s : run.sensors) {
    if (s.robot == robot && s.sensor == sensor) return "sensor " + s.name;
  }
  return fmt::format("sensor {}", sensor.value());
}

std::string command_text(ByteSpan bytes) {
  Command command;
  if (bytes.size() != sizeof command) return fmt::format("{} bytes", bytes.size());
  std::memcpy(&command, bytes.data(), sizeof command);
  std::string text(to_string(command.kind));
  for (std::uint32_t i = 0; i < std::min(command.count, 4U); ++i) {
    text += fmt::format(" {}", command.value[i]);
  }
  return text;
}

std::string reading_text(const record::Percept& percept) {
  std::string text = fmt::format("stamp {:.9f} s, {} records",
                                 SimTime{percept.header.stamp_ns}.seconds(), percept.header.count);
  const ReadingType& type = reading_type(static_cast<ReadingKind>(percept.kind));
  if (type.record_bytes == 0) return text;
  constexpr std::size_t kMost = 8;
  std::size_t numbers = 0;
  text += ":";
  for (std::size_t at = 0; at + type.record_bytes <= percept.records.size();
       at += type.record_bytes) {
    for (const ReadingField& field : type.columns) {
      if (++numbers > kMost) return text + " ...";
      with_number(field, percept.records.data() + at,
                  [&text](auto number) { text += fmt::format(" {}", number); });
    }
  }
  return text;
}

Bytes bytes_of(ByteSpan span) { return {span.begin(), span.end()}; }

Item pose_item(const record::RobotPose& pose) {
  Item item{pose.robot.value(), "pose", {}, {}};
  append(item.bits, pose.true_pose.has_value());
  append(item.bits, pose.true_pose.value_or(Pose2{}));
  append(item.bits, pose.reported_pose.has_value());
  append(item.bits, pose.reported_pose.value_or(Pose2{}));
  append(item.bits, pose.velocity_W);
  item.text = fmt::format("true {}, reported {}, velocity ({}, {}, {})", pose_text(pose.true_pose),
                          pose_text(pose.reported_pose), pose.velocity_W.vx, pose.velocity_W.vy,
                          pose.velocity_W.wz);
  return item;
}

Item percept_item(const record::Percept& percept, const record::RunInfo& run) {
  constexpr std::array kParts = {"", " (real part)", " (virtual part)"};
  Item item{percept.robot.value(), sensor_name(run, percept.robot, percept.sensor), {}, {}};
  item.channel += kParts[std::min<std::size_t>(static_cast<std::size_t>(percept.part), 2)];
  append(item.bits, percept.header);
  item.bits.insert(item.bits.end(), percept.records.begin(), percept.records.end());
  item.text = reading_text(percept);
  return item;
}

Item command_item(const record::CommandRecord& c) {
  return {c.robot.value(), fmt::format("command to controller {}", c.controller.value()),
          bytes_of(c.command), command_text(c.command)};
}

Item actuator_item(const record::ActuatorRecord& c) {
  return {c.robot.value(), fmt::format("command to actuator {}", c.actuator.value()),
          bytes_of(c.command), command_text(c.command)};
}

Item packet_item(const record::RadioPacket& p) {
  Item item{p.from.value(), fmt::format("radio to robot {}", p.to.value()), bytes_of(p.payload),
            fmt::format("{} bytes, {}", p.payload.size(), p.delivered ? "delivered" : "lost")};
  append(item.bits, p.sent_ns);
  append(item.bits, p.received_ns);
  append(item.bits, p.transmitter);
  append(item.bits, p.delivered);
  return item;
}

Item event_item(const record::RunEvent& e) {
  std::string text = e.kind + " " + e.text;
  Bytes bits = bytes_of(std::as_bytes(std::span(text)));
  for (const double value : e.values) append(bits, value);
  return {e.robot.value(), "event", std::move(bits), std::move(text)};
}

/// Empty if the step could not be decoded.
template <class T, class Make>
std::vector<Item> items_of(const Result<record::StepOf<T>>& step, Make make) {
  std::vector<Item> items;
  if (!step) return items;
  for (const T& item : step->items) items.push_back(make(item));
  return items;
}

/// The items of one message; empty if it cannot be decoded.
std::vector<Item> items_of(std::string_view topic, ByteSpan message, const record::RunInfo& run) {
  namespace topics = record::topic;
  if (topic == topics::kPoses) return items_of(record::decode_poses(message), pose_item);
  if (topic == topics::kPercepts) {
    return items_of(record::decode_percepts(message),
                    [&](const record::Percept& percept) { return percept_item(percept, run); });
  }
  if (topic == topics::kCommands) return items_of(record::decode_commands(message), command_item);
  if (topic == topics::kActuators) {
    return items_of(record::decode_actuators(message), actuator_item);
  }
  if (topic == topics::kRadio) return items_of(record::decode_radio(message), packet_item);
  if (topic == topics::kEvents) return items_of(record::decode_event(message), event_item);
  const auto hash = record::decode_hash(message);
  if (!hash) return {};
  return {{RobotId::kNone, "run hash", bytes_of(std::as_bytes(std::span(&hash->hash, 1))),
           fmt::format("{:016x}", hash->hash)}};
}

/// The items of all messages of one topic and step.
std::vector<Item> items_of(std::string_view topic, const std::vector<Bytes>& messages,
                           const record::RunInfo& run) {
  std::vector<Item> all;
  for (const Bytes& message : messages) {
    for (Item& item : items_of(topic, ByteSpan(message), run)) all.push_back(std::move(item));
  }
  return all;
}

RunDifference describe(const Item* recorded, const Item* again, const record::RunInfo& run) {
  const Item& item = recorded != nullptr ? *recorded : *again;
  RunDifference difference;
  for (const record::RecordedRobot& robot : run.robots) {
    if (robot.id.value() == item.robot) difference.robot = robot.name;
  }
  difference.channel = item.channel;
  difference.text =
      fmt::format("recorded: {}; now: {}", recorded != nullptr ? recorded->text : "nothing",
                  again != nullptr ? again->text : "nothing");
  return difference;
}

bool is_lease(const Bytes& message) {
  const auto step = record::decode_event(ByteSpan(message));
  return step && !step->items.empty() &&
         std::ranges::all_of(step->items, [](const record::RunEvent& event) {
           return event.kind == to_string(sim::EventKind::kLease);
         });
}

/// Leases depend on wall time and are no part of the deterministic run, so they are omitted.
std::vector<Bytes> without_leases(std::string_view topic, const std::vector<Bytes>& messages) {
  std::vector<Bytes> left = messages;
  if (topic == record::topic::kEvents) std::erase_if(left, is_lease);
  return left;
}

/// The order of robots of different hosts within a step depends on chance; the messages of one
/// robot in one channel keep their order.
void sort_items(std::vector<Item>& items) {
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) {
    if (a.robot != b.robot) return a.robot < b.robot;
    // Two kinds of events of one robot may come from two processes.
    return a.channel != b.channel ? a.channel < b.channel : a.channel == "event" && a.text < b.text;
  });
}

/// Empty if the messages of a merged recording differ only in their order or in their division into
/// rows.
std::optional<RunDifference> difference_of(std::string_view topic,
                                           const std::vector<Bytes>& recorded,
                                           const std::vector<Bytes>& again,
                                           const record::RunInfo& run, bool merged) {
  std::vector<Item> a = items_of(topic, recorded, run);
  std::vector<Item> b = items_of(topic, again, run);
  if (merged) {
    sort_items(a);
    sort_items(b);
  }
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const Item* const first = i < a.size() ? &a[i] : nullptr;
    const Item* const second = i < b.size() ? &b[i] : nullptr;
    const bool same_place = first != nullptr && second != nullptr &&
                            first->robot == second->robot && first->channel == second->channel;
    if (same_place && first->bits == second->bits) continue;
    if (same_place || first == nullptr || second == nullptr) return describe(first, second, run);
    // One of the two items is missing in the other list: the one of the earlier robot.
    if (first->robot < second->robot) return describe(first, nullptr, run);
    if (second->robot < first->robot) return describe(nullptr, second, run);
    return describe(first, second, run);
  }
  if (merged && !a.empty() && recorded.size() == again.size()) return std::nullopt;
  return RunDifference{0, 0, "", std::string(topic), "the messages differ in form"};
}

/// The same difference, in the step at `time_ns`.
RunDifference at_time(std::uint64_t time_ns, const record::RunInfo& run, RunDifference difference) {
  const std::int64_t step_ns = std::max<std::int64_t>(1, from_seconds(run.step_s).ns);
  difference.step = run.step_s > 0 ? time_ns / static_cast<std::uint64_t>(step_ns) : 0;
  difference.time_s = SimTime{static_cast<std::int64_t>(time_ns)}.seconds();
  return difference;
}

}  // namespace

Result<RecordMatch> match_records(const record::McapReader& recorded,
                                  const record::McapReader& again, const record::RunInfo& run,
                                  RecordForm form) {
  RecordMatch match;
  std::vector<std::string_view> topics;
  for (const char* const topic : kTopics) {
    if (recorded.channel(topic) != nullptr) {
      topics.emplace_back(topic);
    } else {
      match.absent.emplace_back(topic);
    }
  }
  record::MomentCursor a(recorded, topics);
  record::MomentCursor b(again, topics);
  while (true) {
    RAVE_TRY_ASSIGN(const bool more_a, a.next());
    RAVE_TRY_ASSIGN(const bool more_b, b.next());
    // The second run ends after the first step that differs, so an early end alone is no
    // difference.
    if (!more_b || (!more_a && form.cut)) return match;
    if (!more_a) {
      match.difference = at_time(
          b.time_ns(), run,
          {0, 0, "", "record", "the recorded messages end here; the repeated run has more"});
      return match;
    }
    const bool broken_off = form.cut && a.at_last();
    for (const std::string_view topic : topics) {
      const auto& recorded_messages = a.messages(topic);
      const auto& new_messages = b.messages(topic);
      // The last step of an interrupted recording may be incomplete.
      if (broken_off && recorded_messages.size() < new_messages.size()) continue;
      match.messages += recorded_messages.size();
      // The usual case: nothing is decoded.
      if (a.time_ns() == b.time_ns() && recorded_messages == new_messages) continue;
      const auto of_run = without_leases(topic, recorded_messages);
      if (a.time_ns() == b.time_ns() && of_run == new_messages) continue;
      const auto difference = difference_of(topic, of_run, new_messages, run, form.merged);
      if (!difference && a.time_ns() == b.time_ns()) continue;
      // The earlier of the two times is the step that only one of the runs has.
      match.difference = at_time(
          std::min(a.time_ns(), b.time_ns()), run,
          difference.value_or(RunDifference{0, 0, "", std::string(topic), "not at the same time"}));
      return match;
    }
  }
}

}  // namespace rave::runtime
