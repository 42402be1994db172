// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/step_messages.hpp"

#include <algorithm>

#include "input_messages.hpp"
#include "rave/bus/sequence.hpp"
#include "step_parts.hpp"

namespace rave::lock_step {
namespace {

using bus::borrow;
using bus::elements;
using bus::put_text;

/// A flag in the kind of an event: it happened in the completed step before that of its world.
constexpr std::uint32_t kOfStepBefore = 0x8000'0000;

void fill_refusals(const std::vector<sim::InputRefusal>& refusals, std::size_t most,
                   std::vector<rave_wire_InputRefusal>& wire) {
  wire.clear();
  for (const sim::InputRefusal& refusal : refusals) {
    if (wire.size() == most) break;
    wire.emplace_back().number = refusal.sequence;
    put_text(wire.back().text, refusal.text);
  }
}

template <class Sequence>
void read_refusals(const Sequence& wire, std::vector<sim::InputRefusal>& refusals) {
  for (const rave_wire_InputRefusal& refusal : elements(wire)) {
    refusals.push_back({refusal.number, refusal.text});
  }
}

template <class Sequence>
Status read_inputs(const Sequence& wire, std::vector<sim::WorldInput>& inputs) {
  for (const rave_wire_WorldInput& input : elements(wire)) {
    RAVE_TRY_ASSIGN(auto read_input, from_wire(input));
    inputs.push_back(std::move(read_input));
  }
  return {};
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
  // Further texts are omitted: the requests are refused anyway, and the texts are only for people.
  fill_refusals(report.refusals, rave_wire_kMaxRefusals, refusals_);
  borrow(message_.refusals, refusals_);
  // An input that does not fit ends the list; those before it are sent.
  static_cast<void>(inputs_.fill(report.inputs));
  borrow(message_.inputs, inputs_.inputs());
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
  RAVE_TRY(inputs_.fill(world.inputs));
  borrow(message_.inputs, inputs_.inputs());
  fill_answers(world);
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
  if (authority.conductor.size() > rave_wire_kMaxConductorState) {
    return fail(ErrorCode::kInvalidArgument,
                "the conditions of the scenario keep {} bytes; at most {} can be told",
                authority.conductor.size(), rave_wire_kMaxConductorState);
  }
  const auto* const first = reinterpret_cast<const std::uint8_t*>(authority.conductor.data());
  conductor_.assign(first, first + authority.conductor.size());
  borrow(message_.authority.conductor, conductor_);
  return {};
}

void WorldMessage::fill_answers(const sim::WorldStep& world) {
  answers_.clear();
  for (const sim::InputAnswer& answer : world.answers) {
    answers_.push_back({answer.host, answer.asked, answer.sequence});
  }
  borrow(message_.answers, answers_);
  fill_refusals(world.refusals, rave_wire_kMaxInputs, refusals_);
  borrow(message_.refusals, refusals_);
}

Status read(const bus::HostReport& message, sim::HostReport& report) {
  report.begin(message.step);
  report.host = message.host;
  report.state = static_cast<sim::HostState>(message.state);
  report.text = message.text;
  take(message.proposals.id, report.proposals.robots);
  take(message.proposals.vx_mps, report.proposals.vx_mps);
  take(message.proposals.vy_mps, report.proposals.vy_mps);
  take(message.proposals.wz_radps, report.proposals.wz_radps);
  read_parts(message, report);
  read_refusals(message.refusals, report.refusals);
  return read_inputs(message.inputs, report.inputs);
}

namespace {

/// Whether an event may concern no robot.
bool concerns_world(sim::EventKind kind) noexcept {
  return sim::is_of_obstacle(kind) || kind == sim::EventKind::kChangeRefused ||
         kind == sim::EventKind::kScenario || kind == sim::EventKind::kTeamGiven;
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
  const auto conductor = std::as_bytes(elements(message.conductor));
  authority.conductor.assign(conductor.begin(), conductor.end());
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
  for (const rave_wire_InputAnswer& answer : elements(message.answers)) {
    world.answers.push_back({answer.host, answer.asked, answer.number});
  }
  read_refusals(message.refusals, world.refusals);
  return read_inputs(message.inputs, world.inputs);
}

}  // namespace rave::lock_step
