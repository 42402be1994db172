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

Status InputParts::fill(const std::vector<sim::WorldInput>& inputs) {
  inputs_.assign(inputs.size(), {});
  // Never smaller, so that the inner vectors keep their memory from step to step.
  changes_.resize(std::max(changes_.size(), inputs.size()));
  points_.resize(std::max(points_.size(), inputs.size()));
  const auto fill_one = [](const sim::WorldInput& input, rave_wire_WorldInput& wire, auto& changes,
                           auto& points) -> Status {
    wire.number = input.sequence;
    wire.kind = static_cast<std::uint8_t>(input.kind);
    wire.author = input.author.by_hand ? 1 : 0;
    wire.robot = input.robot.value();
    changes.resize(input.changes.size());
    for (std::size_t c = 0; c < input.changes.size(); ++c) {
      RAVE_TRY(to_wire(input.changes[c], changes[c]));
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
  if (input.changes.size() > kMostChanges) {
    return fail(ErrorCode::kInvalidArgument, "{} changes at once; expected at most {}",
                input.changes.size(), kMostChanges);
  }
  for (const sim::ParameterChange& change : input.changes) {
    rave_wire_ParameterChange wire;
    RAVE_TRY(to_wire(change, wire));
  }
  rave_wire_WorldInput wire{};
  std::vector<rave_wire_OrderPoint> points;
  return to_wire(input, wire, points);
}

}  // namespace rave::lock_step
