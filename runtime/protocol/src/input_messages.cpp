// SPDX-License-Identifier: Apache-2.0
#include "input_messages.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "rave/bus/sequence.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/robot/order.hpp"

namespace rave::lock_step {
namespace {

using bus::borrow;
using bus::elements;
using bus::put_text;

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
    // The generated types have no const; a message that is sent is only read.
    borrow(wire.list, const_cast<std::vector<double>&>(value));
    return value.size() <= kMostNumbers ? Status() : does_not_fit("the list", name);
  }
};

Result<sim::ParameterChange> from_wire(const rave_wire_ParameterChange& wire) {
  sim::ParameterChange change;
  change.part = static_cast<sim::ParameterChange::Part>(wire.part);
  // Any number may arrive: the bytes come from another process.
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

}  // namespace

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
  const auto order = request::parts_of(input.as<request::Order>());
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
  wire.vy_mps = order.vy_mps;
  request::put_pedals(order.pedals, wire.pedals);
  wire.speed_mps = order.speed_mps;
  return {};
}

namespace {

using Action = sim::WorldInput::Action;

/// Orders are the last of the actions; on the wire they are counted on.
constexpr std::size_t kFirstOrder = std::variant_size_v<Action> - 1;
static_assert(std::is_same_v<std::variant_alternative_t<kFirstOrder, Action>, request::Order>);

std::uint8_t wire_kind(const sim::WorldInput& input) {
  const auto* const order = input.as<request::Order>();
  return static_cast<std::uint8_t>(input.action.index() + (order ? order->index() : 0));
}

Result<Action> change_from(const rave_wire_WorldInput& wire) {
  sim::Change change;
  for (const rave_wire_ParameterChange& one : elements(wire.changes)) {
    RAVE_TRY_ASSIGN(auto read_change, from_wire(one));
    change.changes.push_back(std::move(read_change));
  }
  return change;
}

Result<Action> action_from(const rave_wire_WorldInput& wire) {
  for (Action hold :
       {Action(request::Stop()), Action(request::Release()), Action(request::Arm())}) {
    if (hold.index() == wire.kind) return hold;
  }
  if (wire.kind == Action(sim::Change()).index()) return change_from(wire);
  // What else comes before orders is an obstacle, which is sent otherwise.
  if (wire.kind < kFirstOrder) {
    return fail(ErrorCode::kInvalidArgument, "an input of an unknown kind");
  }
  std::vector<Vec2> points_W;
  for (const auto& point : elements(wire.points)) points_W.push_back({point.x_m, point.y_m});
  request::OrderParts parts{points_W, {}, wire.v_mps, wire.w_radps, wire.speed_mps, wire.text};
  if (wire.has_yaw) parts.yaw_rad = wire.yaw_rad;
  parts.vy_mps = wire.vy_mps;
  parts.pedals = request::pedals_of(wire.pedals);
  const auto kind = static_cast<OrderKind>(wire.kind - kFirstOrder + 1);
  RAVE_TRY_ASSIGN(auto order, request::make_order(kind, parts));
  return order;
}

}  // namespace

Result<sim::WorldInput> from_wire(const rave_wire_WorldInput& wire) {
  sim::WorldInput input;
  input.sequence = wire.number;
  RAVE_TRY_ASSIGN(input.action, action_from(wire));
  if (wire.author > 1) return fail(ErrorCode::kInvalidArgument, "an input of an unknown author");
  input.author = {wire.author != 0, wire.by};
  input.robot = RobotId(wire.robot);
  return input;
}

Status InputParts::fill(const std::vector<sim::WorldInput>& inputs) {
  inputs_.assign(inputs.size(), {});
  // Never smaller, so that the inner vectors keep their memory from step to step.
  changes_.resize(std::max(changes_.size(), inputs.size()));
  points_.resize(std::max(points_.size(), inputs.size()));
  const auto fill_one = [](const sim::WorldInput& input, rave_wire_WorldInput& wire, auto& changes,
                           auto& points) -> Status {
    wire.number = input.sequence;
    wire.kind = wire_kind(input);
    wire.author = input.author.by_hand ? 1 : 0;
    wire.robot = input.robot.value();
    const auto* const change = input.as<sim::Change>();
    changes.resize(change != nullptr ? change->changes.size() : 0);
    for (std::size_t c = 0; c < changes.size(); ++c) {
      RAVE_TRY(to_wire(change->changes[c], changes[c]));
    }
    borrow(wire.changes, changes);
    return to_wire(input, wire, points);
  };
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    Status filled = fill_one(inputs[i], inputs_[i], changes_[i], points_[i]);
    if (filled) continue;
    // What was filled before stays in the message and is valid.
    inputs_.resize(i);
    return filled;
  }
  return {};
}

Status check_fits(const sim::WorldInput& input) {
  constexpr std::size_t kMostChanges = 64;
  if (const auto* const change = input.as<sim::Change>()) {
    if (change->changes.size() > kMostChanges) {
      return fail(ErrorCode::kInvalidArgument, "{} changes at once; expected at most {}",
                  change->changes.size(), kMostChanges);
    }
    for (const sim::ParameterChange& one : change->changes) {
      rave_wire_ParameterChange wire;
      RAVE_TRY(to_wire(one, wire));
    }
  }
  rave_wire_WorldInput wire{};
  std::vector<rave_wire_OrderPoint> points;
  return to_wire(input, wire, points);
}

}  // namespace rave::lock_step
