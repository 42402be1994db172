// SPDX-License-Identifier: Apache-2.0
// What people ask of robots while a run goes.
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine_impl.hpp"
#include "input_notes.hpp"
#include "order_checks.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

using InputKind = WorldInput::Kind;

/// Of a goal for a controller that does not say its own.
constexpr double kTolerance_m = 0.1;
constexpr std::string_view kToleranceParam = "tolerance_m";

tl::unexpected<Error> refused(const EngineSpec& spec, const WorldInput& input, ErrorCode code,
                              std::string_view why) {
  return fail(code, "robot `{}`, {}: {}", spec.robots[input.robot.value()].name,
              to_string(order_kind(input.kind)), why);
}

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

Command command_of(const WorldInput& input) {
  const OrderDetails& order = input.order;
  if (input.kind == InputKind::kDrive) return velocity_command(order.v_mps, order.w_radps);
  return goal_command(order.points_W.front().x, order.points_W.front().y, order.speed_mps);
}

}  // namespace

OrderSet Engine::Impl::takes(RobotId robot) const {
  const RobotGroup& group = groups[group_index[robot.value()]];
  const std::size_t m = member_index[robot.value()];
  OrderSet set = 0;
  if (group.type->simulated) set |= order_bit(OrderKind::kPlace);
  if (controller_for(group, m, CommandKind::kVelocity)) set |= order_bit(OrderKind::kDrive);
  if (controller_for(group, m, CommandKind::kGoal)) set |= order_bit(OrderKind::kGoal);
  for (const OrderKind kind : {OrderKind::kGoal, OrderKind::kPath, OrderKind::kText}) {
    if (takes_by_program(group, m, kind)) set |= order_bit(kind);
  }
  return set;
}

/// Whether a robot may be moved by people at all now.
Status Engine::Impl::check_moved(const WorldInput& input) {
  const auto holds = robot_guards[input.robot.value()].holds();
  if (holds.stopped) {
    return refused(spec, input, ErrorCode::kState,
                   "it is stopped; a stop holds until it is released");
  }
  if (!holds.armed) return refused(spec, input, ErrorCode::kState, "it waits to be armed");
  const Twin* const twin = find_twin(input.robot);
  if (twin != nullptr && twin->state.under_way) {
    return refused(spec, input, ErrorCode::kState, "it is being handed over");
  }
  return {};
}

Status Engine::Impl::order(const WorldInput& input) {
  if (input.kind == InputKind::kCancel) {
    cancel_orders(input);
    return {};
  }
  if (!is_local(input.robot.value())) {
    return refused(spec, input, ErrorCode::kState, "it runs on another host");
  }
  switch (input.kind) {
    case InputKind::kText:
      return order_text_for(input);
    case InputKind::kPlace:
      return place(input);
    default:
      RAVE_TRY(check_moved(input));
      return order_motion(input);
  }
}

Status Engine::Impl::order_text_for(const WorldInput& input) {
  const RobotGroup& group = groups[group_index[input.robot.value()]];
  if (!takes_by_program(group, member_index[input.robot.value()], OrderKind::kText)) {
    return refused(spec, input, ErrorCode::kInvalidArgument, "its program takes no texts");
  }
  orders_of(input.robot).wait_for_program(input);
  note_order(input, EventKind::kOrdered);
  return {};
}

Status Engine::Impl::order_motion(const WorldInput& input) {
  RobotGroup& group = groups[group_index[input.robot.value()]];
  const std::size_t m = member_index[input.robot.value()];
  const bool drive = input.kind == InputKind::kDrive;
  const OrderKind kind = order_kind(input.kind);
  if (!drive && takes_by_program(group, m, kind)) {
    OrderedRobot& robot = orders_of(input.robot);
    give_back(input.robot, robot);
    robot.of_program = true;
    robot.under_way = order_text(input);
    robot.by = input.author.name;
    robot.wait_for_program(input);
    note_order(input, EventKind::kOrdered);
    return {};
  }
  if (input.kind == InputKind::kPath) {
    return refused(spec, input, ErrorCode::kInvalidArgument, "its program takes no paths");
  }
  const auto controller =
      controller_for(group, m, drive ? CommandKind::kVelocity : CommandKind::kGoal);
  if (!controller) {
    return refused(spec, input, ErrorCode::kInvalidArgument,
                   drive ? "none of its controllers takes a velocity that an actuator obeys"
                         : "neither its program nor one of its controllers takes goals");
  }
  steer_by(input, *controller);
  return {};
}

/// A controller does what is asked, in the place of the program.
void Engine::Impl::steer_by(const WorldInput& input, std::uint32_t controller) {
  RobotGroup& group = groups[group_index[input.robot.value()]];
  const std::size_t m = member_index[input.robot.value()];
  const bool drive = input.kind == InputKind::kDrive;
  OrderedRobot& robot = orders_of(input.robot);
  // A stick speaks many times a second: that somebody drives is told once.
  const bool goes_on = drive && robot.driven && robot.by == input.author.name;
  if (!goes_on) give_back(input.robot, robot);
  if (robot.of_program) tell_cancelled(input, robot);
  robot.controller = controller;
  robot.command = command_of(input);
  robot.driven = drive;
  robot.reached = false;
  robot.tolerance_m = drive ? 0 : tolerance_of(group.controllers[controller], m);
  robot.under_way = drive ? "drive" : order_text(input);
  robot.by = input.author.name;
  group.program.items[m].driven = 1;
  if (!goes_on) return note_order(input, EventKind::kOrdered);
  if (input.author.by_hand) ++by_hand;
  static_cast<void>(noted_order(step, input, EventKind::kOrdered, hash));
}

/// The program learns that what it was asked for counts no more.
void Engine::Impl::tell_cancelled(const WorldInput& input, OrderedRobot& robot) {
  WorldInput cancel;
  cancel.kind = InputKind::kCancel;
  cancel.author = input.author;
  cancel.robot = input.robot;
  robot.of_program = false;
  robot.wait_for_program(cancel);
}

/// The program has the controllers of a robot again.
void Engine::Impl::give_back(RobotId id, OrderedRobot& robot) {
  if (!robot.controller) return;
  RobotGroup& group = groups[group_index[id.value()]];
  const std::size_t m = member_index[id.value()];
  ControllerSlots& slots = group.controllers[*robot.controller];
  // It stands until the program speaks.
  slots.last[m] = {};
  slots.last_step[m] = -1;
  robot.controller.reset();
  robot.driven = false;
  group.program.items[m].driven = 0;
}

bool Engine::Impl::end_orders(const WorldInput& input, RobotId id) {
  OrderedRobot* const robot = orders ? orders->find(id) : nullptr;
  if (robot == nullptr || robot->under_way.empty()) return false;
  give_back(id, *robot);
  WorldInput own = input;
  own.robot = id;
  if (robot->of_program) tell_cancelled(own, *robot);
  robot->under_way.clear();
  robot->by.clear();
  return true;
}

void Engine::Impl::cancel_orders(const WorldInput& input) {
  for (std::uint32_t r = 0; orders && r < spec.robots.size(); ++r) {
    if (!is_local(r) || (input.robot.valid() && input.robot.value() != r)) continue;
    WorldInput own = input;
    own.robot = RobotId(r);
    if (end_orders(own, own.robot)) note_order(own, EventKind::kOrdered);
  }
}

void Engine::Impl::note_order(const WorldInput& input, EventKind kind) {
  if (input.author.by_hand) ++by_hand;
  pending.push_back(noted_order(step, input, kind, hash));
}

OrderedRobot& Engine::Impl::orders_of(RobotId robot) {
  if (!orders) orders = std::make_unique<OrderBook>();
  return orders->at(robot);
}

Status Engine::Impl::place(const WorldInput& input) {
  if (host) {
    return refused(spec, input, ErrorCode::kState,
                   "only the authority of the world can place robots");
  }
  const Vec2 p_WR = input.order.points_W.front();
  const double yaw_rad = input.order.yaw_rad.value_or(truth.movers[input.robot.value()].X_WR.yaw);
  const Status placed = truth.place(input.robot, {p_WR.x, p_WR.y, wrap_angle(yaw_rad)});
  if (!placed) return refused(spec, input, placed.error().code, placed.error().message);
  note_order(input, EventKind::kPlaced);
  return {};
}

/// Programs that decide in this step get what people have asked of their robots.
void Engine::Impl::show_orders() {
  for (auto& [r, robot] : orders->robots()) {
    if (robot.waiting.empty()) continue;
    RobotGroup& group = groups[group_index[r]];
    ProgramSlots& program = group.program;
    const std::size_t m = member_index[r];
    if (program.spec == nullptr || program.failed[m] != 0) {
      robot.waiting.clear();
      continue;
    }
    if (!due(program.spec->period_steps, program.spec->phase_steps)) continue;
    robot.show();
    program.items[m].orders = robot.items.data();
    program.items[m].order_count = static_cast<std::uint32_t>(robot.items.size());
  }
}

void Engine::Impl::hide_orders() {
  for (auto& [r, robot] : orders->robots()) {
    if (robot.shown.empty()) continue;
    DecideItem& item = groups[group_index[r]].program.items[member_index[r]];
    item.orders = nullptr;
    item.order_count = 0;
    robot.shown.clear();
  }
}

/// What programs said in this step becomes events of it.
void Engine::Impl::take_answers() {
  std::uint32_t number = 0;
  std::uint32_t of_robot = RobotId::kNone;
  for (AnswerBook::Answer& answer : answers.take(static_cast<std::int64_t>(now.seconds()))) {
    const RobotId id(answer.robot);
    number = answer.robot == of_robot ? number + 1 : 0;
    of_robot = answer.robot;
    ItemHash item(step, answer.robot, HashChannel::kCommand, 0x8000'0000U | number);
    item.add_bytes(std::as_bytes(std::span(answer.text)));
    hash.add(item);
    if (!answer.text.empty()) {
      events.push_back({step, id, EventKind::kSaid, BodyId(), std::move(answer.text)});
    }
    OrderedRobot* const robot = orders && answer.done ? orders->find(id) : nullptr;
    if (robot == nullptr || !robot->of_program) continue;
    robot->of_program = false;
    robot->under_way.clear();
    robot->by.clear();
  }
}

/// What people ask of controllers takes the place of what programs gave them in this step.
void Engine::Impl::steer() {
  for (auto& [r, robot] : orders->robots()) {
    if (!robot.controller) continue;
    RobotGroup& group = groups[group_index[r]];
    const std::size_t m = member_index[r];
    ControllerSlots& own = group.controllers[*robot.controller];
    const auto present = static_cast<std::int64_t>(step);
    for (ControllerSlots& slots : group.controllers) {
      // The one that was given a command last speaks to the actuator.
      if (slots.spec->actuator != own.spec->actuator) continue;
      slots.last_step[m] = std::min(slots.last_step[m], present - 1);
    }
    own.last[m] = robot.command;
    own.last_step[m] = present;
    if (!robot.driven && !robot.reached) look_at_goal(RobotId(r), robot);
  }
}

void Engine::Impl::look_at_goal(RobotId id, OrderedRobot& robot) {
  const ReportedPose& pose = reported[id.value()];
  const double dx_m = robot.command.value[0] - pose.pose.x_m;
  const double dy_m = robot.command.value[1] - pose.pose.y_m;
  const bool there = pose.known && !pose.stale &&
                     dx_m * dx_m + dy_m * dy_m <= robot.tolerance_m * robot.tolerance_m;
  if (!there) return;
  robot.reached = true;
  events.push_back({step, id, EventKind::kOrdered, BodyId(), robot.under_way + ": reached"});
  robot.under_way += ", reached";
}

Status Engine::order(const WorldInput& input) {
  RAVE_TRY(check_order(impl_->spec, input));
  return impl_->order(input);
}

OrderSet Engine::takes(RobotId robot) const noexcept {
  return is_local(robot) ? impl_->takes(robot) : 0;
}

std::string Engine::order_of(RobotId robot) const {
  const OrderedRobot* const ordered = impl_->orders ? impl_->orders->find(robot) : nullptr;
  return ordered != nullptr ? ordered->under_way : std::string();
}

}  // namespace rave::sim
