// SPDX-License-Identifier: Apache-2.0
// Orders of people: given to the program if it takes their kind, otherwise to a controller in the
// place of the program. Controllers get them again in each step, as if a program spoke.
#include "order_book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "order_checks.hpp"
#include "rave/base/check.hpp"

namespace rave::sim {
namespace {

/// Of a goal for a controller that does not say its own.
constexpr double kTolerance_m = 0.1;
constexpr std::string_view kToleranceParam = "tolerance_m";

/// The first controller of a robot that accepts a kind of command, with an actuator that obeys.
std::optional<std::uint32_t> controller_for(const RobotGroup& group, std::size_t m,
                                            CommandKind kind) {
  for (std::uint32_t c = 0; c < group.controllers.size(); ++c) {
    const ControllerSpec& spec = *group.controllers[c].spec;
    if (spec.accepts == kind && group.actuators[spec.actuator].obeys[m] != 0) return c;
  }
  return std::nullopt;
}

bool takes_by_program(const RobotGroup& group, std::size_t m, OrderKind kind) {
  const ProgramSlots& program = group.program;
  return program.spec != nullptr && program.failed[m] == 0 &&
         has_order(program.spec->takes(), kind);
}

double tolerance_of(const ControllerSlots& slots, std::size_t m) {
  const auto values = slots.changed[m] ? slots.changed[m]->values() : slots.spec->params.values();
  for (const ParamValue& value : values) {
    if (kToleranceParam == value.name) return value.number;
  }
  return kTolerance_m;
}

/// The controller of a drive: that of the pedals if the person has some and the robot, too.
std::optional<std::uint32_t> controller_of(const RobotGroup& group, std::size_t m,
                                           const request::Drive& drive) {
  const auto velocity = controller_for(group, m, CommandKind::kVelocity);
  if (!drive.pedals && velocity) return velocity;
  const auto pedals = controller_for(group, m, CommandKind::kPedals);
  return pedals ? pedals : velocity;
}

/// The command of an order that a controller carries out: a drive or a goal.
Command command_of(const WorldInput& input, CommandKind accepted) {
  if (const auto* const drive = input.as<request::Drive>()) {
    if (accepted == CommandKind::kVelocity) {
      return velocity_command(drive->v_mps, drive->w_radps, drive->vy_mps);
    }
    // Without pedals the foot is on the brake.
    const request::Pedals pedals = drive->pedals.value_or(request::Pedals{.brake = 1});
    return pedals_command(pedals.steering, pedals.throttle, pedals.brake, pedals.gear);
  }
  const auto* const goal = input.as<request::Goal>();
  RAVE_CHECK(goal != nullptr);
  return goal_command(goal->p_W.x, goal->p_W.y, goal->speed_mps);
}

}  // namespace

OrderedRobot* OrderBook::find(RobotId robot) noexcept {
  const auto found = robots_.find(robot.value());
  return found == robots_.end() ? nullptr : &found->second;
}

std::string OrderBook::under_way(RobotId robot) const {
  const auto found = robots_.find(robot.value());
  return found == robots_.end() ? std::string() : found->second.under_way;
}

OrderSet OrderBook::takes(RobotId robot) const {
  const RobotGroup& group = roster_.group_of(robot);
  const std::size_t m = roster_.member_of(robot);
  OrderSet set = 0;
  if (group.type->simulated) set |= order_bit(OrderKind::kPlace);
  if (controller_of(group, m, {})) set |= order_bit(OrderKind::kDrive);
  if (controller_for(group, m, CommandKind::kGoal)) set |= order_bit(OrderKind::kGoal);
  for (const OrderKind kind : {OrderKind::kGoal, OrderKind::kPath, OrderKind::kText}) {
    if (takes_by_program(group, m, kind)) set |= order_bit(kind);
  }
  return set;
}

Status OrderBook::check(const WorldInput& input, const GuardHolds& holds, bool handed_over) const {
  // A text moves nothing, so a robot that stands may get one.
  if (input.is<request::Text>()) return check_text(input);
  // Refused and not kept: a robot must not begin to drive by an old order when it is released.
  if (holds.stopped) {
    return refused_order(spec_, input, ErrorCode::kState,
                         "it is stopped; a stop holds until it is released");
  }
  if (!holds.armed) {
    return refused_order(spec_, input, ErrorCode::kState, "it waits to be armed");
  }
  if (handed_over) {
    return refused_order(spec_, input, ErrorCode::kState, "it is being handed over");
  }
  RAVE_TRY(taker(input));
  return {};
}

Status OrderBook::take(std::uint64_t step, const WorldInput& input, const GuardHolds& holds,
                       bool handed_over) {
  RAVE_TRY(check(input, holds, handed_over));
  if (input.is<request::Text>()) {
    robots_[input.robot.value()].wait_for_program(input);
    log_.note_order(step, input, EventKind::kOrdered);
    return {};
  }
  RAVE_TRY_ASSIGN(const auto controller, taker(input));
  if (controller) {
    give_to_controller(step, input, *controller);
  } else {
    give_to_program(step, input);
  }
  return {};
}

Status OrderBook::check_text(const WorldInput& input) const {
  const RobotGroup& group = roster_.group_of(input.robot);
  if (takes_by_program(group, roster_.member_of(input.robot), OrderKind::kText)) return {};
  return refused_order(spec_, input, ErrorCode::kInvalidArgument, "its program takes no texts");
}

Result<std::optional<std::uint32_t>> OrderBook::taker(const WorldInput& input) const {
  const RobotGroup& group = roster_.group_of(input.robot);
  const std::size_t m = roster_.member_of(input.robot);
  const bool drive = input.is<request::Drive>();
  // The program first: it knows about its task what a controller does not.
  if (!drive && takes_by_program(group, m, order_kind(input))) {
    return std::optional<std::uint32_t>();
  }
  if (input.is<request::Path>()) {
    return refused_order(spec_, input, ErrorCode::kInvalidArgument, "its program takes no paths");
  }
  const auto controller = drive ? controller_of(group, m, *input.as<request::Drive>())
                                : controller_for(group, m, CommandKind::kGoal);
  if (controller) return controller;
  return refused_order(spec_, input, ErrorCode::kInvalidArgument,
                       drive ? "none of its controllers takes a velocity that an actuator obeys"
                             : "neither its program nor one of its controllers takes goals");
}

void OrderBook::give_to_program(std::uint64_t step, const WorldInput& input) {
  OrderedRobot& robot = robots_[input.robot.value()];
  give_back(input.robot, robot);
  robot.of_program = true;
  robot.under_way = order_text(input);
  robot.by = input.author.name;
  robot.wait_for_program(input);
  log_.note_order(step, input, EventKind::kOrdered);
}

/// A controller does what is asked, in the place of the program.
void OrderBook::give_to_controller(std::uint64_t step, const WorldInput& input,
                                   std::uint32_t controller) {
  RobotGroup& group = roster_.group_of(input.robot);
  const std::size_t m = roster_.member_of(input.robot);
  const bool drive = input.is<request::Drive>();
  OrderedRobot& robot = robots_[input.robot.value()];
  // A joystick sends many times a second: only the first velocity is an event.
  const bool goes_on =
      drive && robot.driven && robot.by == input.author.name && robot.controller == controller;
  if (!goes_on) give_back(input.robot, robot);
  if (robot.of_program) tell_cancelled(input, robot);
  robot.controller = controller;
  robot.command = command_of(input, group.controllers[controller].spec->accepts);
  robot.driven = drive;
  robot.reached = false;
  robot.tolerance_m = drive ? 0 : tolerance_of(group.controllers[controller], m);
  robot.under_way = drive ? "drive" : order_text(input);
  robot.by = input.author.name;
  group.program.items[m].driven = 1;
  if (goes_on) {
    log_.count_order(step, input, EventKind::kOrdered);
  } else {
    log_.note_order(step, input, EventKind::kOrdered);
  }
}

/// The program learns that what it was asked for counts no more.
void OrderBook::tell_cancelled(const WorldInput& input, OrderedRobot& robot) {
  WorldInput cancel;
  cancel.action = request::Order(request::Cancel{});
  cancel.author = input.author;
  cancel.robot = input.robot;
  robot.of_program = false;
  robot.wait_for_program(cancel);
}

/// The program has the controllers of a robot again.
void OrderBook::give_back(RobotId id, OrderedRobot& robot) {
  if (!robot.controller) return;
  RobotGroup& group = roster_.group_of(id);
  const std::size_t m = roster_.member_of(id);
  ControllerSlots& slots = group.controllers[*robot.controller];
  // It stands until the program speaks.
  slots.last[m] = {};
  slots.last_step[m] = -1;
  robot.controller.reset();
  robot.driven = false;
  group.program.items[m].driven = 0;
}

bool OrderBook::end(const WorldInput& input, RobotId id) {
  OrderedRobot* const robot = find(id);
  // A program that is done stands where it was sent until it hears otherwise.
  if (robot == nullptr || (robot->under_way.empty() && !robot->of_program)) return false;
  give_back(id, *robot);
  WorldInput own = input;
  own.robot = id;
  if (robot->of_program) tell_cancelled(own, *robot);
  robot->under_way.clear();
  robot->by.clear();
  return true;
}

bool OrderBook::end(RobotId robot, const Author& author) {
  WorldInput cancel;
  cancel.author = author;
  return end(cancel, robot);
}

void OrderBook::cancel(std::uint64_t step, const WorldInput& input) {
  for (const auto& [r, robot] : robots_) {
    if (input.robot.valid() && input.robot.value() != r) continue;
    WorldInput own = input;
    own.robot = RobotId(r);
    if (end(own, own.robot)) log_.note_order(step, own, EventKind::kOrdered);
  }
}

void OrderBook::show(std::uint64_t step) {
  for (auto& [r, robot] : robots_) {
    if (robot.waiting.empty()) continue;
    RobotGroup& group = roster_.group_of(RobotId(r));
    ProgramSlots& program = group.program;
    const std::size_t m = roster_.member_of(RobotId(r));
    if (program.spec == nullptr || program.failed[m] != 0) {
      robot.waiting.clear();
      continue;
    }
    // Orders wait for the next decision of the program, which may be some steps away.
    if (!is_due(step, program.spec->period_steps, program.spec->phase_steps)) continue;
    robot.show();
    program.items[m].orders = robot.items.data();
    program.items[m].order_count = static_cast<std::uint32_t>(robot.items.size());
  }
}

void OrderBook::hide() {
  for (auto& [r, robot] : robots_) {
    if (robot.shown.empty()) continue;
    DecideItem& item = roster_.group_of(RobotId(r)).program.items[roster_.member_of(RobotId(r))];
    item.orders = nullptr;
    item.order_count = 0;
    robot.shown.clear();
  }
}

void OrderBook::take_answers(const OrderMoment& moment, AnswerBook& answers) {
  std::uint32_t number = 0;
  std::uint32_t of_robot = RobotId::kNone;
  for (AnswerBook::Answer& answer : answers.take(static_cast<std::int64_t>(moment.now.seconds()))) {
    const RobotId id(answer.robot);
    // Answers are sorted by robot; the number tells those of one robot in one step apart in the
    // hash.
    number = answer.robot == of_robot ? number + 1 : 0;
    of_robot = answer.robot;
    ItemHash item(moment.step, answer.robot, HashChannel::kCommand, 0x8000'0000U | number);
    item.add_bytes(std::as_bytes(std::span(answer.text)));
    moment.hash.add(item);
    if (!answer.text.empty()) {
      moment.events.push_back(
          {moment.step, id, EventKind::kSaid, BodyId(), std::move(answer.text)});
    }
    OrderedRobot* const robot = answer.done ? find(id) : nullptr;
    if (robot == nullptr || !robot->of_program) continue;
    robot->under_way.clear();
    robot->by.clear();
  }
}

void OrderBook::steer(const OrderMoment& moment) {
  for (auto& [r, robot] : robots_) {
    if (!robot.controller) continue;
    RobotGroup& group = roster_.group_of(RobotId(r));
    const std::size_t m = roster_.member_of(RobotId(r));
    ControllerSlots& own = group.controllers[*robot.controller];
    const auto present = static_cast<std::int64_t>(moment.step);
    // A program that keeps commanding another controller of the actuator must not win.
    for (ControllerSlots& slots : group.controllers) {
      // The one that was given a command last speaks to the actuator.
      if (slots.spec->actuator != own.spec->actuator) continue;
      slots.last_step[m] = std::min(slots.last_step[m], present - 1);
    }
    // Given anew in each step, so that its age is 0: no person has to repeat an order for the
    // watchdog.
    own.last[m] = robot.command;
    own.last_step[m] = present;
    if (!robot.driven && !robot.reached) look_at_goal(moment, RobotId(r), robot);
  }
}

void OrderBook::look_at_goal(const OrderMoment& moment, RobotId id, OrderedRobot& robot) {
  const ReportedPose& pose = moment.reported[id.value()];
  const double dx_m = robot.command.value[0] - pose.pose.x_m;
  const double dy_m = robot.command.value[1] - pose.pose.y_m;
  // A robot whose pose is lost has reached nothing.
  const bool there = pose.known && !pose.stale &&
                     dx_m * dx_m + dy_m * dy_m <= robot.tolerance_m * robot.tolerance_m;
  if (!there) return;
  robot.reached = true;
  moment.events.push_back(
      {moment.step, id, EventKind::kOrdered, BodyId(), robot.under_way + ": reached"});
  robot.under_way += ", reached";
}

}  // namespace rave::sim
