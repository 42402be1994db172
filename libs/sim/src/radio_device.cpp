// SPDX-License-Identifier: Apache-2.0
// Messages through devices: packets that come in are checked, attributed and judged by the
// receiver; messages that go out are encoded. These runs are live, so nothing here has to be
// repeatable.
#include <algorithm>
#include <cmath>
#include <optional>

#include "radio.hpp"
#include "rave/base/crash_note.hpp"

namespace rave::sim {
namespace {

/// Senders beyond the robots of the scenario that get a number; anybody may send.
constexpr std::size_t kMaxForeign = 4096;
/// The number of senders that the log names per transmitter.
constexpr std::size_t kMostFlooders = 64;

/// Where the sender says it is; if it does not know, where this host knows it to be.
std::optional<Vec2> position_of(const RadioMoment& moment, const RadioPacket& packet,
                                std::uint32_t from) {
  if (packet.position) return Vec2{packet.position->x_m, packet.position->y_m};
  if (from >= moment.reported.size() || !moment.reported[from].known) return std::nullopt;
  return Vec2{moment.reported[from].pose.x_m, moment.reported[from].pose.y_m};
}

}  // namespace

void Radio::hear(const RadioMoment& moment) {
  for (RadioLine& line : lines_) {
    if (!line.port) continue;
    note_device(moment, line);
    note_flood(line);
    std::span<const std::byte> bytes;
    while (line.port->next(bytes)) {
      const auto packet = decode_radio_packet(bytes);
      if (packet) {
        hear_packet(moment, line, *packet);
      } else {
        ++counts_.garbled;
      }
    }
  }
}

void Radio::note_device(const RadioMoment& moment, RadioLine& line) {
  const std::string failure = line.port->failure();
  if (failure.empty() != line.failed) return;
  line.failed = !line.failed;
  moment.events->push_back({moment.step, RobotId(line.robot),
                            line.failed ? EventKind::kDriverFailed : EventKind::kDriverBack,
                            BodyId(),
                            fmt::format("transmitter `{}`: {}", line.spec->name,
                                        line.failed ? failure : "works again")});
}

/// Counts what was lost since the last step, and names who sent too much, once.
void Radio::note_flood(RadioLine& line) {
  const RadioPort::Overruns overruns = line.port->take_overruns();
  counts_.overrun += overruns.count;
  if (overruns.sender == 0 || line.flooders.size() >= kMostFlooders ||
      std::ranges::find(line.flooders, overruns.sender) != line.flooders.end()) {
    return;
  }
  line.flooders.push_back(overruns.sender);
  const auto known = by_hash_.find(overruns.sender);
  const bool robot = known != by_hash_.end() && known->second < spec_.robots.size();
  const std::string who = robot ? fmt::format("robot `{}`", spec_.robots[known->second].name)
                                : fmt::format("an unknown sender (hash {:08x})", overruns.sender);
  services_of(logs_[line.robot])
      .write(LogLevel::kWarning, fmt::format("transmitter `{}`: {} sends too much; the surplus is "
                                             "dropped, {} packets in this step",
                                             line.spec->name, who, overruns.count));
}

/// Of the sender's communicators that by which the message was sent, as its own host counts them,
/// so that chance treats it as if it had been carried in process.
std::uint32_t Radio::sending_device(std::uint32_t from, const RadioPacket& packet) const {
  if (from >= spec_.robots.size()) return packet.channel % LinkQuery::kRadioDevice;
  const auto& all = spec_.types[spec_.robots[from].type].communicators;
  std::uint32_t device = 0;
  while (device < all.size() && radio_name_hash(all[device].name) != packet.channel) ++device;
  return device;
}

std::uint32_t Radio::robot_of_hash(std::uint32_t hash) {
  const auto known = by_hash_.find(hash);
  if (known != by_hash_.end()) return known->second;
  if (foreign_.size() >= kMaxForeign) return kNobody;
  const auto id = static_cast<std::uint32_t>(spec_.robots.size() + foreign_.size());
  foreign_.push_back(hash);
  by_hash_.emplace(hash, id);
  return id;
}

void Radio::hear_packet(const RadioMoment& moment, RadioLine& line, const RadioPacket& packet) {
  const RobotSpec& robot = spec_.robots[line.robot];
  const auto speaks = [&](std::uint32_t e) {
    return channels_[endpoints_[e].channel].hash == packet.channel;
  };
  const auto found = std::find_if(line.senders.begin(), line.senders.end(), speaks);
  const bool for_us =
      packet.to == RecipientKind::kEveryone ||
      (packet.to == RecipientKind::kRobot && packet.recipient == name_hash_[line.robot]) ||
      (packet.to == RecipientKind::kTeam && !robot.team.empty() &&
       packet.recipient == radio_name_hash(robot.team));
  // A radio also receives what is not for it: other networks, its own echo, other channels, other
  // robots. That is counted and not an error.
  if (packet.network != line.declaration.network || packet.sender == name_hash_[line.robot] ||
      found == line.senders.end() || !for_us) {
    ++counts_.foreign;
    return;
  }
  if (!line.repeats.accept(packet.sender, packet.channel, packet.boot, packet.sequence)) {
    ++counts_.repeated;
    return;
  }
  Endpoint& to = endpoints_[*found];
  const std::uint32_t from = robot_of_hash(packet.sender);
  ++counts_.heard;
  ++counts_.addressed;
  if (!in_reach(moment, to, packet, from)) return;
  if (packet.payload.size() > longest_message_) {
    ++counts_.lost_mailbox;
    return;
  }
  StoredPacket stored;
  // The time of this host: the clock of the sender may be another one.
  stored.head.stamp_ns = moment.now.ns;
  stored.head.from = from;
  stored.head.sequence = packet.sequence;
  stored.head.to = {packet.to, packet.to == RecipientKind::kRobot ? line.robot : Recipient{}.robot};
  stored.head.size = static_cast<std::uint32_t>(packet.payload.size());
  const std::uint32_t id = packets_.add(stored, packet.payload);
  done_.push_back(id);
  hand_over(moment, to, stored.head, id);
}

bool Radio::in_reach(const RadioMoment& moment, const Endpoint& to, const RadioPacket& packet,
                     std::uint32_t from) {
  // The rule of reach_one(), with what the packet says instead of what the sender's host knows.
  const std::optional<Vec2> said = position_of(moment, packet, from);
  const PacketOrigin origin{said.value_or(Vec2{}), packet.range_m, packet.antenna_z_m,
                            said.has_value(), packet.line_of_sight};
  const bool known = from < spec_.robots.size();
  LinkQuery query;
  query.bytes = static_cast<std::uint32_t>(packet.payload.size());
  // The number of a stranger depends on who else was heard before, its name does not.
  query.from = known ? from : packet.sender;
  query.sequence = packet.sequence;
  query.device = LinkQuery::kRadioDevice | sending_device(from, packet);
  const BodyId body = known ? moment.snapshot->body_of(RobotId(from)) : BodyId();
  Reach asked;
  // How long it took is up to the device; what the model adds is left out.
  const bool arrives = link(origin, body, to, query, moment, asked).has_value();
  counts_ += asked.counts;
  if (asked.failed_model != kNobody) count_failure(moment, asked);
  return arrives;
}

void Radio::transmit(const RadioMoment& moment, RadioLine& line, std::uint32_t packet) {
  const StoredPacket& stored = packets_[packet];
  const Endpoint& sender = endpoints_[stored.endpoint];
  const RadioDeclaration& radio = models_[sender.model].declaration;
  RadioPacket out;
  out.network = line.declaration.network;
  out.boot = line.declaration.boot;
  out.sender = name_hash_[line.robot];
  out.channel = channels_[sender.channel].hash;
  out.to = stored.head.to.kind;
  const std::uint32_t to = stored.head.to.robot;
  // Numbers of robots mean nothing outside the scenario; names are sent as hashes.
  if (out.to == RecipientKind::kRobot) {
    const std::size_t robots = spec_.robots.size();
    if (to < robots) {
      out.recipient = name_hash_[to];
    } else if (to - robots < foreign_.size()) {
      out.recipient = foreign_[to - robots];
    }
  } else if (out.to == RecipientKind::kTeam && sender.team != kNobody) {
    out.recipient = radio_name_hash(teams_[sender.team]);
  }
  // A message without receivers is not sent.
  if (out.to != RecipientKind::kEveryone && out.recipient == 0) {
    ++counts_.sent;
    return;
  }
  out.sequence = stored.head.sequence;
  out.stamp_ns = stored.head.stamp_ns;
  const ReportedPose& pose = moment.reported[line.robot];
  if (pose.known) out.position = {pose.pose.x_m, pose.pose.y_m};
  out.range_m = radio.range_m;
  out.antenna_z_m = radio.antenna_z_m;
  out.line_of_sight = radio.line_of_sight != 0;
  out.payload = packets_.bytes_of(packet);
  const std::size_t size = encode(out, encoded_);
  ErrorText error;
  const char* const name = spec_.robots[line.robot].name.c_str();
  const CrashNote whose{"transmitter", line.spec->driver.c_str(), name, name};
  const CrashScope scope(whose);
  if (size == 0 || line.spec->ops->send(line.instance.at(0), encoded_.data(), size, &error) != 0) {
    ++counts_.lost_device;
    return;
  }
  ++counts_.sent;
  trace(stored.head, sender, false, stored.complete_ns, packet);
}

}  // namespace rave::sim
