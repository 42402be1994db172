// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/step_messages.hpp"

#include <algorithm>

#include "rave/bus/sequence.hpp"
#include "rave/robot/order.hpp"

namespace rave::lock_step {
namespace {

using bus::borrow;
using bus::elements;
using bus::put_text;

/// A flag in the kind of an event: it happened in the completed step before that of its world.
constexpr std::uint32_t kOfStepBefore = 0x8000'0000;

/// Columns are sent as they are in memory; the message refers to them without copying and only
/// reads them.
template <class Sequence, class T>
void lend(Sequence& sequence, const std::vector<T>& values) {
  borrow(sequence, const_cast<std::vector<T>&>(values));
}

template <class Sequence>
void lend_bytes(Sequence& sequence, const std::vector<std::byte>& bytes) {
  sequence._buffer = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(bytes.data()));
  sequence._length = static_cast<std::uint32_t>(bytes.size());
  sequence._maximum = sequence._length;
  sequence._release = false;
}

template <class Sequence, class T>
void take(const Sequence& sequence, std::vector<T>& values) {
  const auto all = elements(sequence);
  values.assign(all.begin(), all.end());
}

rave_wire_PoseReport to_wire(const sim::PoseReport& report) {
  const sim::ReportedPose& reported = report.reported;
  const PoseReading& pose = reported.pose;
  return {report.robot.value(),
          reported.known,
          reported.stale,
          pose.x_m,
          pose.y_m,
          pose.yaw_rad,
          pose.variance_xy_m2,
          pose.variance_yaw_rad2,
          reported.velocity.vx,
          reported.velocity.vy,
          reported.velocity.wz,
          reported.stamp.ns};
}

sim::PoseReport from_wire(const rave_wire_PoseReport& wire) {
  sim::PoseReport report;
  report.robot = RobotId(wire.robot);
  report.reported = {
      {wire.x_m, wire.y_m, wire.yaw_rad, wire.variance_xy_m2, wire.variance_yaw_rad2},
      {wire.vx_mps, wire.vy_mps, wire.wz_radps},
      SimTime{wire.stamp_ns},
      wire.known,
      wire.stale};
  return report;
}

rave_wire_PoseSample to_wire(const sim::PoseSample& sample) {
  return {sample.robot.value(), sample.stamp.ns, sample.X_WR.x, sample.X_WR.y, sample.X_WR.yaw};
}

sim::PoseSample from_wire(const rave_wire_PoseSample& wire) {
  return {RobotId(wire.robot), SimTime{wire.stamp_ns}, {wire.x_m, wire.y_m, wire.yaw_rad}};
}

rave_wire_SentPacket to_wire(const sim::SentPacket& packet) {
  return {packet.robot.value(),
          packet.communicator,
          packet.sequence,
          static_cast<std::uint32_t>(packet.to.kind),
          packet.to.robot,
          packet.stamp_ns,
          packet.complete_ns,
          packet.x_m,
          packet.y_m,
          packet.range_m,
          packet.antenna_z_m,
          packet.located != 0,
          packet.line_of_sight != 0,
          packet.first_byte,
          packet.size};
}

sim::SentPacket from_wire(const rave_wire_SentPacket& wire) {
  sim::SentPacket packet;
  packet.robot = RobotId(wire.robot);
  packet.communicator = wire.communicator;
  packet.sequence = wire.number;
  packet.to = {static_cast<RecipientKind>(wire.to_kind), wire.to_robot};
  packet.stamp_ns = wire.stamp_ns;
  packet.complete_ns = wire.complete_ns;
  packet.x_m = wire.x_m;
  packet.y_m = wire.y_m;
  packet.range_m = wire.range_m;
  packet.antenna_z_m = wire.antenna_z_m;
  packet.located = wire.located ? 1 : 0;
  packet.line_of_sight = wire.line_of_sight ? 1 : 0;
  packet.first_byte = wire.first_byte;
  packet.size = wire.size;
  return packet;
}

/// Converts all elements of a vector, in either direction.
template <class From, class To>
void all_to_wire(const std::vector<From>& from, std::vector<To>& to) {
  to.clear();
  for (const From& one : from) to.push_back(to_wire(one));
}

template <class Sequence, class To>
void all_from_wire(const Sequence& sequence, std::vector<To>& to) {
  to.clear();
  for (const auto& one : elements(sequence)) to.push_back(from_wire(one));
}

/// Fills the parts common to reports and worlds: poses, samples and messages.
template <class Message, class Plain>
void fill_parts(const Plain& plain, WireParts& parts, Message& message) {
  all_to_wire(plain.poses, parts.poses);
  borrow(message.poses, parts.poses);
  all_to_wire(plain.samples, parts.samples);
  borrow(message.samples, parts.samples);
  all_to_wire(plain.sent.packets, parts.packets);
  borrow(message.sent.packets, parts.packets);
  lend_bytes(message.sent.bytes, plain.sent.bytes);
}

template <class Message, class Plain>
void read_parts(const Message& message, Plain& plain) {
  all_from_wire(message.poses, plain.poses);
  all_from_wire(message.samples, plain.samples);
  all_from_wire(message.sent.packets, plain.sent.packets);
  const auto bytes = std::as_bytes(elements(message.sent.bytes));
  plain.sent.bytes.assign(bytes.begin(), bytes.end());
}

template <class Sequence>
void fill_sizes(const std::vector<sim::ResizedRobot>& robots,
                std::vector<rave_wire_ResizedRobot>& wire, Sequence& sequence) {
  wire.clear();
  for (const sim::ResizedRobot& robot : robots) {
    auto& one = wire.emplace_back();
    one.robot = robot.robot.value();
    one.scale = robot.scale;
    put_text(one.author, robot.by);
  }
  borrow(sequence, wire);
}

template <class Sequence>
void read_sizes(const Sequence& sequence, std::vector<sim::ResizedRobot>& robots) {
  for (const auto& robot : elements(sequence)) {
    robots.push_back({RobotId(robot.robot), robot.scale, robot.author});
  }
}

Status does_not_fit(std::string_view what, std::string_view name) {
  return fail(ErrorCode::kInvalidArgument,
              "{} of parameter `{}` is too long to be sent to another process", what, name);
}

/// Stores the value of a change in its wire member.
struct PutValue {
  rave_wire_ParameterChange& wire;
  const std::string& name;

  Status operator()(double value) const {
    wire.kind = rave_wire_VALUE_NUMBER;
    wire.number = value;
    return {};
  }
  Status operator()(const std::string& value) const {
    wire.kind = rave_wire_VALUE_TEXT;
    return put_text(wire.text, value) ? Status() : does_not_fit("the text", name);
  }
  Status operator()(const std::vector<double>& value) const {
    constexpr std::size_t kMostNumbers = 1024;
    wire.kind = rave_wire_VALUE_LIST;
    lend(wire.list, value);
    return value.size() <= kMostNumbers ? Status() : does_not_fit("the list", name);
  }
};

Status to_wire(const sim::ParameterChange& change, rave_wire_ParameterChange& wire) {
  wire = {};
  wire.part = static_cast<std::uint8_t>(change.part);
  wire.index = change.index;
  if (!put_text(wire.name, change.name)) return does_not_fit("the name", change.name);
  return std::visit(PutValue{wire, change.name}, change.value);
}

/// Converts the author and the details of an order.
Status to_wire(const sim::WorldInput& input, rave_wire_WorldInput& wire,
               std::vector<rave_wire_OrderPoint>& points) {
  const sim::OrderDetails& order = input.order;
  if (!put_text(wire.by, input.author.name) || !put_text(wire.text, order.text) ||
      order.points_W.size() > kMostOrderPoints) {
    return fail(ErrorCode::kInvalidArgument,
                "an order is too long to be sent to another process: at most {} points, {} bytes "
                "of text, {} bytes of a name",
                kMostOrderPoints, kMostOrderText, kMostOrderAuthor);
  }
  points.clear();
  for (const Vec2 p_W : order.points_W) points.push_back({p_W.x, p_W.y});
  borrow(wire.points, points);
  wire.has_yaw = order.yaw_rad.has_value();
  wire.yaw_rad = order.yaw_rad.value_or(0);
  wire.v_mps = order.v_mps;
  wire.w_radps = order.w_radps;
  wire.speed_mps = order.speed_mps;
  return {};
}

Result<sim::ParameterChange> from_wire(const rave_wire_ParameterChange& wire) {
  sim::ParameterChange change;
  change.part = static_cast<sim::ParameterChange::Part>(wire.part);
  if (change.part > sim::ParameterChange::Part::kBody) {
    return fail(ErrorCode::kInvalidArgument, "a parameter of an unknown part of a robot");
  }
  change.index = wire.index;
  change.name = wire.name;
  switch (wire.kind) {
    case rave_wire_VALUE_NUMBER:
      change.value = wire.number;
      break;
    case rave_wire_VALUE_TEXT:
      change.value = std::string(wire.text);
      break;
    case rave_wire_VALUE_LIST: {
      const auto list = elements(wire.list);
      change.value = std::vector<double>(list.begin(), list.end());
      break;
    }
  }
  return change;
}

Result<sim::WorldInput> from_wire(const rave_wire_WorldInput& wire) {
  sim::WorldInput input;
  input.sequence = wire.number;
  input.kind = static_cast<sim::WorldInput::Kind>(wire.kind);
  input.author.by_hand = wire.author != 0;
  const bool known = input.kind <= sim::WorldInput::Kind::kChange || sim::is_order(input.kind);
  if (!known || wire.author > 1) {
    return fail(ErrorCode::kInvalidArgument, "an input of an unknown kind or author");
  }
  input.robot = RobotId(wire.robot);
  for (const rave_wire_ParameterChange& change : elements(wire.changes)) {
    RAVE_TRY_ASSIGN(auto read_change, from_wire(change));
    input.changes.push_back(std::move(read_change));
  }
  input.author.name = wire.by;
  for (const auto& point : elements(wire.points)) {
    input.order.points_W.push_back({point.x_m, point.y_m});
  }
  if (wire.has_yaw) input.order.yaw_rad = wire.yaw_rad;
  input.order.v_mps = wire.v_mps;
  input.order.w_radps = wire.w_radps;
  input.order.speed_mps = wire.speed_mps;
  input.order.text = wire.text;
  return input;
}

}  // namespace

bus::HostReport& ReportMessage::fill(const sim::HostReport& report, std::uint64_t epoch,
                                     std::uint64_t hash) {
  message_.host = report.host;
  message_.epoch = epoch;
  message_.step = report.step;
  message_.state = static_cast<rave_wire_ReportState>(report.state);
  put_text(message_.text, report.text);
  message_.hash = hash;
  lend(message_.proposals.id, report.proposals.robots);
  lend(message_.proposals.vx_mps, report.proposals.vx_mps);
  lend(message_.proposals.vy_mps, report.proposals.vy_mps);
  lend(message_.proposals.wz_radps, report.proposals.wz_radps);
  fill_parts(report, parts_, message_);
  refusals_.clear();
  for (const sim::InputRefusal& refusal : report.refusals) {
    // Further texts are omitted: the requests are refused anyway, and the texts are only for
    // people.
    if (refusals_.size() == rave_wire_kMaxRefusals) break;
    refusals_.emplace_back();
    refusals_.back().number = refusal.sequence;
    put_text(refusals_.back().text, refusal.text);
  }
  borrow(message_.refusals, refusals_);
  return message_;
}

Result<bus::LastWorld*> WorldMessage::fill(const sim::WorldStep& world,
                                           const sim::AuthorityState& authority,
                                           std::uint64_t epoch) {
  message_.epoch = epoch;
  message_.step = world.step;
  message_.last = world.last;
  lend(message_.x_m, world.x_m);
  lend(message_.y_m, world.y_m);
  lend(message_.yaw_rad, world.yaw_rad);
  lend(message_.vx_mps, world.vx_mps);
  lend(message_.vy_mps, world.vy_mps);
  lend(message_.wz_radps, world.wz_radps);
  lend(message_.flags, world.flags);
  pushed_.clear();
  for (const sim::PushedRobot& robot : world.pushed) {
    pushed_.push_back({robot.robot.value(), robot.X_WR.x, robot.X_WR.y, robot.X_WR.yaw});
  }
  borrow(message_.pushed, pushed_);
  touches_.clear();
  for (const sim::TouchPoint& point : world.touches) {
    touches_.push_back({point.robot.value(), point.direction_W.x, point.direction_W.y});
  }
  borrow(message_.touches, touches_);
  fill_sizes(world.resized, resized_, message_.resized);
  fill_parts(world, parts_, message_);
  RAVE_TRY(fill_authority(authority));
  RAVE_TRY(obstacles_.fill(world.obstacles));
  borrow(message_.obstacles, obstacles_.changes());
  RAVE_TRY(fill_inputs(world));
  return &message_;
}

void WorldMessage::address(std::span<const std::uint64_t> hosts) {
  hosts_.assign(hosts.begin(), hosts.end());
  borrow(message_.hosts, hosts_);
}

Status WorldMessage::fill_authority(const sim::AuthorityState& authority) {
  message_.authority.hash = authority.hash.value();
  message_.authority.inputs = authority.inputs;
  events_.clear();
  for (const sim::Event& event : authority.events) {
    events_.push_back(
        {event.robot.value(), static_cast<std::uint32_t>(event.kind), event.other.value()});
  }
  for (const sim::Event& event : authority.done) {
    // Events that do not fit are missing only in the report about the run.
    if (events_.size() >= rave_wire_kMaxRobots) break;
    events_.push_back({event.robot.value(), static_cast<std::uint32_t>(event.kind) | kOfStepBefore,
                       event.other.value()});
  }
  borrow(message_.authority.events, events_);
  pinned_.clear();
  for (const RobotId robot : authority.pinned) pinned_.push_back(robot.value());
  borrow(message_.authority.pinned, pinned_);
  fill_sizes(authority.scales, scales_, message_.authority.scales);
  message_.authority.obstacle_changes = authority.obstacle_changes;
  RAVE_TRY(obstacles_before_.fill(authority.obstacles));
  borrow(message_.authority.obstacles, obstacles_before_.changes());
  message_.authority.refused_count = authority.refused_count;
  refused_.resize(authority.refused.size());
  for (std::size_t i = 0; i < refused_.size(); ++i) {
    const sim::Event& event = authority.refused[i];
    refused_[i].step = event.step;
    refused_[i].robot = event.robot.value();
    put_text(refused_[i].text, event.text);
  }
  borrow(message_.authority.refused, refused_);
  return {};
}

Status WorldMessage::fill_inputs(const sim::WorldStep& world) {
  inputs_.assign(world.inputs.size(), {});
  changes_.resize(std::max(changes_.size(), world.inputs.size()));
  points_.resize(std::max(points_.size(), world.inputs.size()));
  for (std::size_t i = 0; i < world.inputs.size(); ++i) {
    const sim::WorldInput& input = world.inputs[i];
    rave_wire_WorldInput& wire = inputs_[i];
    wire.number = input.sequence;
    wire.kind = static_cast<std::uint8_t>(input.kind);
    wire.author = input.author.by_hand ? 1 : 0;
    wire.robot = input.robot.value();
    changes_[i].resize(input.changes.size());
    for (std::size_t c = 0; c < input.changes.size(); ++c) {
      RAVE_TRY(to_wire(input.changes[c], changes_[i][c]));
    }
    borrow(wire.changes, changes_[i]);
    RAVE_TRY(to_wire(input, wire, points_[i]));
  }
  borrow(message_.inputs, inputs_);
  return {};
}

Status check_fits(const sim::WorldInput& input) {
  constexpr std::size_t kMostChanges = 64;
  if (input.changes.size() > kMostChanges) {
    return fail(ErrorCode::kInvalidArgument, "{} changes at once; expected at most {}",
                input.changes.size(), kMostChanges);
  }
  for (const sim::ParameterChange& change : input.changes) {
    rave_wire_ParameterChange wire;
    RAVE_TRY(to_wire(change, wire));
  }
  return {};
}

void read(const bus::HostReport& message, sim::HostReport& report) {
  report.begin(message.step);
  report.host = message.host;
  report.state = static_cast<sim::HostState>(message.state);
  report.text = message.text;
  take(message.proposals.id, report.proposals.robots);
  take(message.proposals.vx_mps, report.proposals.vx_mps);
  take(message.proposals.vy_mps, report.proposals.vy_mps);
  take(message.proposals.wz_radps, report.proposals.wz_radps);
  read_parts(message, report);
  for (const rave_wire_InputRefusal& refusal : elements(message.refusals)) {
    report.refusals.push_back({refusal.number, refusal.text});
  }
}

namespace {

/// Whether an event may concern no robot.
bool concerns_world(sim::EventKind kind) noexcept {
  return sim::is_of_obstacle(kind) || kind == sim::EventKind::kChangeRefused;
}

template <class Sequence>
Status read_obstacles(const Sequence& sequence, std::vector<sim::ObstacleChange>& changes) {
  for (const rave_wire_ObstacleChange& wire : elements(sequence)) {
    RAVE_TRY_ASSIGN(auto change, read_obstacle(wire));
    changes.push_back(std::move(change));
  }
  return {};
}

/// Reads an event of the step before that of the world.
Status read_done(const rave_wire_NotedEvent& event, std::uint64_t step,
                 std::vector<sim::Event>& done) {
  const auto kind = static_cast<sim::EventKind>(event.kind & ~kOfStepBefore);
  const bool pinned = kind == sim::EventKind::kPinned;
  const bool told = pinned || kind == sim::EventKind::kContact;
  if (!told || event.robot == rave_wire_kNone || step == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "an event of kind {} of the step before {}; expected a contact or pin of a robot",
                event.kind & ~kOfStepBefore, step);
  }
  done.push_back({step - 1, RobotId(event.robot), kind, BodyId(event.other),
                  std::string(pinned ? sim::kPinnedText : ""), 0});
  return {};
}

Status read_authority(const rave_wire_AuthorityState& message, std::uint64_t step,
                      sim::AuthorityState& authority) {
  authority = {};
  authority.hash = RunHash::of_value(message.hash);
  authority.inputs = message.inputs;
  for (const auto& event : elements(message.events)) {
    if ((event.kind & kOfStepBefore) != 0) {
      RAVE_TRY(read_done(event, step, authority.done));
      continue;
    }
    const auto kind = static_cast<sim::EventKind>(event.kind);
    const bool of_obstacle = sim::is_of_obstacle(kind);
    if (event.robot == rave_wire_kNone ? !concerns_world(kind) : of_obstacle) {
      return fail(ErrorCode::kInvalidArgument, "an event of kind {} with {} robot", event.kind,
                  of_obstacle ? "a" : "no");
    }
    authority.events.push_back({step, RobotId(event.robot), static_cast<sim::EventKind>(event.kind),
                                BodyId(event.other), "", 0});
  }
  for (const std::uint32_t robot : elements(message.pinned)) authority.pinned.emplace_back(robot);
  read_sizes(message.scales, authority.scales);
  authority.obstacle_changes = message.obstacle_changes;
  authority.refused_count = message.refused_count;
  for (const auto& refused : elements(message.refused)) {
    authority.refused.push_back({refused.step, RobotId(refused.robot),
                                 sim::EventKind::kChangeRefused, BodyId(), refused.text, 0});
  }
  return read_obstacles(message.obstacles, authority.obstacles);
}

}  // namespace

Status read(const bus::WorldStep& message, sim::WorldStep& world, sim::AuthorityState& authority) {
  world.begin(message.step, message.flags._length);
  world.last = message.last;
  take(message.x_m, world.x_m);
  take(message.y_m, world.y_m);
  take(message.yaw_rad, world.yaw_rad);
  take(message.vx_mps, world.vx_mps);
  take(message.vy_mps, world.vy_mps);
  take(message.wz_radps, world.wz_radps);
  take(message.flags, world.flags);
  for (const auto& robot : elements(message.pushed)) {
    world.pushed.push_back({RobotId(robot.robot), {robot.x_m, robot.y_m, robot.yaw_rad}});
  }
  for (const auto& point : elements(message.touches)) {
    world.touches.push_back({RobotId(point.robot), {point.x, point.y}});
  }
  read_sizes(message.resized, world.resized);
  read_parts(message, world);
  RAVE_TRY(read_authority(message.authority, message.step, authority));
  RAVE_TRY(read_obstacles(message.obstacles, world.obstacles));
  for (const rave_wire_WorldInput& input : elements(message.inputs)) {
    RAVE_TRY_ASSIGN(auto read_input, from_wire(input));
    world.inputs.push_back(std::move(read_input));
  }
  return {};
}

}  // namespace rave::lock_step
