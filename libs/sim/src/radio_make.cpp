// SPDX-License-Identifier: Apache-2.0
// The fixed part of the radio: models by type, endpoints by robot and communicator, lines by robot
// and transmitter, channels by name. Their numbers are the same on all hosts.
#include <algorithm>
#include <utility>

#include "plugin_call.hpp"
#include "radio.hpp"
#include "rave/base/check.hpp"
#include "robot_group.hpp"

namespace rave::sim {
namespace {

Status check(const RadioDeclaration& radio) {
  // A packet has 16 bits for the size of a message; the other limits bound the memory of mailboxes.
  const bool sound = radio.range_m >= 0 && radio.byte_rate >= 0 && radio.max_messages > 0 &&
                     radio.max_message_bytes > 0 && radio.max_message_bytes <= 0xFFFFU &&
                     radio.max_mailbox_bytes >= radio.max_message_bytes &&
                     radio.max_messages <= 0xFFFFU && radio.max_mailbox_bytes <= (1U << 24U);
  if (sound) return {};
  return fail(ErrorCode::kPlugin,
              "declared a radio of {} m, {} B/s, messages of {} B, mailboxes of {} messages and "
              "{} B",
              radio.range_m, radio.byte_rate, radio.max_message_bytes, radio.max_messages,
              radio.max_mailbox_bytes);
}

}  // namespace

Status Radio::make() {
  // One entry more than robots: the endpoints of robot r are those from its entry to the next.
  first_endpoint_.assign(spec_.robots.size() + 1, 0);
  first_line_.assign(spec_.robots.size() + 1, 0);
  infos_.resize(spec_.types.size());
  RAVE_TRY(make_models());
  for (std::uint32_t r = 0; r < spec_.robots.size(); ++r) RAVE_TRY(make_robot(r));
  lay_out_mailboxes();
  clear();
  return {};
}

// One model for all robots of a type: link() gets all that differs by robot in its query.
Status Radio::make_models() {
  models_of_.resize(spec_.types.size());
  for (std::uint32_t r = 0; r < spec_.robots.size(); ++r) {
    const std::uint32_t t = spec_.robots[r].type;
    const RobotType& type = spec_.types[t];
    if (local_[r] == 0 || !models_of_[t].empty()) continue;
    for (const CommunicatorSpec& communicator : type.communicators) {
      RadioModel& model = models_.emplace_back();
      model.spec = &communicator;
      RAVE_TRY(model.instance.make(communicator.ops->instance, 1));
      const DeviceSetup setup = device_setup({spec_, logs_, this}, RobotId(r), communicator.params);
      Status status = called([&](ErrorText* error) {
        return communicator.ops->start(model.instance.at(0), &setup, &model.declaration, error);
      });
      if (status) status = check(model.declaration);
      RAVE_TRY(of_part(spec_.robots[r], named_part("communicator", communicator), status));
      const RadioDeclaration& radio = model.declaration;
      longest_message_ = std::max(longest_message_, radio.max_message_bytes);
      infos_[t].push_back({communicator.name.c_str(), radio.max_messages, radio.max_mailbox_bytes,
                           radio.max_message_bytes, 0});
      models_of_[t].push_back(static_cast<std::uint32_t>(models_.size() - 1));
    }
  }
  return {};
}

std::uint32_t Radio::team_of(std::uint32_t robot) {
  const std::string& team = spec_.robots[robot].team;
  if (team.empty()) return kNobody;
  const auto found = std::find(teams_.begin(), teams_.end(), team);
  if (found == teams_.end()) teams_.push_back(team);
  return static_cast<std::uint32_t>(std::find(teams_.begin(), teams_.end(), team) - teams_.begin());
}

Status Radio::make_robot(std::uint32_t robot) {
  const std::uint32_t t = spec_.robots[robot].type;
  const RobotType& type = spec_.types[t];
  const auto first = static_cast<std::uint32_t>(lines_.size());
  name_hash_.push_back(radio_name_hash(spec_.robots[robot].name));
  by_hash_.emplace(name_hash_.back(), robot);
  for (std::uint32_t i = 0; i < type.transmitters.size(); ++i) {
    RadioLine& line = lines_.emplace_back();
    line.spec = &type.transmitters[i];
    line.robot = robot;
    line.device = i;
  }
  for (std::uint32_t c = 0; c < type.communicators.size(); ++c) {
    const CommunicatorSpec& communicator = type.communicators[c];
    RAVE_CHECK(communicator.transmitter < type.transmitters.size());
    Endpoint endpoint;
    endpoint.robot = robot;
    endpoint.device = c;
    // Robots of other hosts have endpoints, too, so that endpoints have the same numbers on every
    // host.
    endpoint.model = local_[robot] != 0 ? models_of_[t][c] : kNobody;
    endpoint.line = first + communicator.transmitter;
    endpoint.team = team_of(robot);
    const auto same = [&](const Channel& channel) { return channel.name == communicator.name; };
    const auto known = std::find_if(channels_.begin(), channels_.end(), same);
    endpoint.channel = static_cast<std::uint32_t>(known - channels_.begin());
    if (known == channels_.end()) {
      Channel& channel = channels_.emplace_back();
      channel.name = communicator.name;
      channel.hash = radio_name_hash(communicator.name);
    }
    // In the order of the file, which decides between messages that could begin at the same time.
    lines_[endpoint.line].senders.push_back(static_cast<std::uint32_t>(endpoints_.size()));
    endpoints_.push_back(std::move(endpoint));
  }
  first_endpoint_[robot + 1] = static_cast<std::uint32_t>(endpoints_.size());
  first_line_[robot + 1] = static_cast<std::uint32_t>(lines_.size());
  return {};
}

// One allocation for all boxes, in the order in which they are read. Programs get pointers into it.
void Radio::lay_out_mailboxes() {
  std::size_t heads = 0;
  std::size_t bytes = 0;
  for (const Endpoint& endpoint : endpoints_) {
    if (local_[endpoint.robot] == 0) continue;
    heads += std::size_t{2} * models_[endpoint.model].declaration.max_messages;
    bytes += std::size_t{2} * models_[endpoint.model].declaration.max_mailbox_bytes;
  }
  mailbox_heads_.resize(heads);
  mailbox_bytes_.resize(bytes);
  MessageHead* head = mailbox_heads_.data();
  std::byte* data = mailbox_bytes_.data();
  for (Endpoint& endpoint : endpoints_) {
    views_.push_back({&endpoint.in, &endpoint.out});
    if (local_[endpoint.robot] == 0) continue;
    const RadioDeclaration& radio = models_[endpoint.model].declaration;
    for (Mailbox* box : {&endpoint.in, &endpoint.out}) {
      *box = {head, data, radio.max_messages, radio.max_mailbox_bytes, 0, 0, 0, 0};
      head += radio.max_messages;
      data += radio.max_mailbox_bytes;
    }
  }
}

void Radio::clear() {
  for (Endpoint& endpoint : endpoints_) {
    endpoint.in.clear();
    endpoint.shares.clear();
    endpoint.out.clear();
    endpoint.sequence = 0;
    endpoint.waiting.clear();
    endpoint.first_waiting = 0;
    endpoint.queue_bytes = 0;
    endpoint.free_ns = 0;
  }
  for (RadioLine& line : lines_) {
    line.free_ns = 0;
    line.on_air.clear();
    line.under_way = 0;
    line.failed = false;
    line.repeats.clear();
    line.flooders.clear();
    if (line.port) line.port->clear();
  }
  for (RadioModel& model : models_) model.failed = false;
  // Strangers of the last run get their numbers anew, in the order in which they are heard.
  std::erase_if(by_hash_, [&](const auto& known) { return known.second >= spec_.robots.size(); });
  foreign_.clear();
  packets_.begin(longest_message_);
  arrivals_.clear(0);
  done_.clear();
  traces_.clear();
  trace_packets_.clear();
  counts_ = {};
}

Status Radio::configure_line(RadioLine& line) {
  RAVE_TRY(line.instance.make(line.spec->ops->instance, 1));
  auto setup =
      setup_of<HardwareSetup>({spec_, logs_, this}, RobotId(line.robot), line.spec->params);
  setup.folder = spec_.types[spec_.robots[line.robot].type].folder.c_str();
  RAVE_TRY(called([&](ErrorText* error) {
    return line.spec->ops->configure(line.instance.at(0), &setup, &line.declaration, error);
  }));
  // Carried by the engine itself: no queue, no device to open.
  if (line.declaration.in_process != 0) return {};
  // A device follows the wall clock, and lock-step must not.
  if (spec_.local && !spec_.own_authority) {
    return fail(ErrorCode::kInvalidArgument,
                "is a device, which follows the wall clock; robots of several hosts in lock-step "
                "need the transmitter `in_process`");
  }
  if (!(line.declaration.byte_rate >= 0)) {
    return fail(ErrorCode::kPlugin, "declared {} B/s", line.declaration.byte_rate);
  }
  RAVE_TRY(check_packet_sizes(line));
  live_ = true;
  line.port = std::make_unique<RadioPort>(line.declaration.max_packet_bytes);
  encoded_.resize(std::max<std::size_t>(encoded_.size(), line.declaration.max_packet_bytes));
  return {};
}

Status Radio::check_packet_sizes(const RadioLine& line) const {
  for (const std::uint32_t e : line.senders) {
    const RadioModel& model = models_[endpoints_[e].model];
    const std::size_t needed = model.declaration.max_message_bytes + kRadioPacketOverhead;
    if (needed <= line.declaration.max_packet_bytes) continue;
    return fail(ErrorCode::kInvalidArgument,
                "carries packets of up to {} bytes, but communicator `{}` sends messages of up to "
                "{} bytes, {} with their header",
                line.declaration.max_packet_bytes, model.spec->name,
                model.declaration.max_message_bytes, needed);
  }
  return {};
}

Status Radio::open_line(RadioLine& line) {
  RAVE_TRY(called([&](ErrorText* error) {
    return line.spec->ops->open(line.instance.at(0), line.port.get(), error);
  }));
  line.open = true;
  return {};
}

Status Radio::open() {
  for (RadioLine& line : lines_) {
    if (local_[line.robot] == 0) continue;
    Status status;
    // Configured once; a reset opens the same devices again.
    if (!configured_) status = configure_line(line);
    if (status && line.declaration.in_process == 0) status = open_line(line);
    RAVE_TRY(of_part(spec_.robots[line.robot], named_part("transmitter", *line.spec), status));
  }
  if (!configured_) name_channels();
  configured_ = true;
  return {};
}

void Radio::name_channels() {
  for (Channel& channel : channels_) channel.team_sizes.assign(teams_.size(), 0);
  for (std::uint32_t e = 0; e < endpoints_.size(); ++e) {
    const Endpoint& endpoint = endpoints_[e];
    if (local_[endpoint.robot] == 0 || lines_[endpoint.line].declaration.in_process == 0) continue;
    Channel& channel = channels_[endpoint.channel];
    channel.members.push_back(e);
    if (endpoint.team != kNobody) ++channel.team_sizes[endpoint.team];
    channel.largest_range_m =
        std::max(channel.largest_range_m, models_[endpoint.model].declaration.range_m);
  }
}

std::vector<ToClose> Radio::take_open() {
  std::vector<ToClose> drivers;
  for (RadioLine& line : lines_) {
    if (!std::exchange(line.open, false)) continue;
    drivers.push_back({RobotId(line.robot), "transmitter", line.spec->name.c_str(),
                       line.spec->driver.c_str(), line.spec->ops->close, line.instance.at(0),
                       false});
  }
  return drivers;
}

std::string Radio::report(RobotId robot, std::uint32_t transmitter) const {
  RAVE_CHECK(local_[robot.value()] != 0);
  const RadioLine& line = lines_[first_line_[robot.value()] + transmitter];
  return report_of(*line.spec->ops, line.instance.at(0));
}

}  // namespace rave::sim
