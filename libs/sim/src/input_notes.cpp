// SPDX-License-Identifier: Apache-2.0
// What people and the scenario did, as events and in the run hash. Both are made here alone, so
// that an engine and the authority of several hosts give the same sums.
#include "input_notes.hpp"

#include <utility>

#include "order_checks.hpp"
#include "parameters.hpp"
#include "rave/sim/authority_state.hpp"

namespace rave::sim {

std::string by_hand_text(const Author& author) {
  return author.name.empty() ? "by hand" : "by hand: " + author.name;
}

bool says_by_hand(std::string_view text) noexcept {
  return text.starts_with("by hand") || text.find("(by hand") != std::string_view::npos;
}

namespace {

std::string with_author(std::string text, const Author& author) {
  if (!author.by_hand) return text;
  const std::string by = by_hand_text(author);
  return text.empty() ? by : fmt::format("{} ({})", text, by);
}

}  // namespace

Event resized_event(std::uint64_t step, const ResizedRobot& robot, double before, bool by_hand) {
  return {step, robot.robot, EventKind::kChanged, BodyId(),
          with_author(body_change_text(before, robot.scale), Author{by_hand, robot.by})};
}

Event noted_input(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                  const Author& author, RunHash& hash) {
  text = with_author(std::move(text), author);
  ItemHash item(step, robot.value(), HashChannel::kInput, static_cast<std::uint32_t>(kind));
  item.add_bytes(std::as_bytes(std::span(text)));
  hash.add(item);
  return {step, robot, kind, BodyId(), std::move(text)};
}

namespace {

void add_shape(ItemHash& item, const world::Shape& shape) {
  item.add(static_cast<std::uint64_t>(shape.kind));
  item.add_bytes(std::as_bytes(shape.vertices()));
  for (const double number :
       {shape.centre.x, shape.centre.y, shape.radius_m, shape.z0_m, shape.z1_m}) {
    item.add(number);
  }
}

void add_body(ItemHash& item, const world::Body& body) {
  item.add(static_cast<std::uint64_t>(body.layer));
  // One more than the code, so that no code differs from code 0.
  item.add(body.code ? std::uint64_t{1} + static_cast<std::uint32_t>(*body.code) : 0);
  item.add(body.code_z0_m);
  item.add(body.code_z1_m);
  for (const world::Shape& shape : body.shapes) add_shape(item, shape);
}

}  // namespace

Event noted_obstacle(std::uint64_t step, const ObstacleChange& change, std::string_view note,
                     const Author& author, RunHash& hash) {
  Event event = obstacle_event(step, change, note, author);
  const Pose2& X_WB = change.X_WB;
  ItemHash item(step, RobotId::kNone, HashChannel::kInput, static_cast<std::uint32_t>(event.kind));
  item.add(std::uint64_t{change.id.value()});
  item.add_bytes(std::as_bytes(std::span(event.text)));
  if (change.kind != ObstacleChange::Kind::kRemove) {
    for (const double number : {X_WB.x, X_WB.y, X_WB.yaw}) item.add(number);
  }
  // Of a known obstacle the number says which body it is.
  if (change.kind == ObstacleChange::Kind::kAdd) add_body(item, change.body);
  hash.add(item);
  return event;
}

namespace {

/// The hash counts the kinds of orders from 5 on, as when they were in one list behind a stop, a
/// release, an arming, a change and an obstacle. Recorded hashes depend on these numbers; those of
/// OrderKind are part of the plug-in interface.
std::uint32_t hash_number(const WorldInput& input) {
  return 4 + static_cast<std::uint32_t>(order_kind(input));
}

}  // namespace

Event noted_order(std::uint64_t step, const WorldInput& input, EventKind kind, RunHash& hash) {
  const request::OrderParts order = order_parts(input);
  // Both kinds are in the key, so that no two inputs of a robot in one step hash alike by chance of
  // their fields.
  ItemHash item(step, input.robot.value(), HashChannel::kInput,
                static_cast<std::uint32_t>(kind) << 8U | hash_number(input));
  for (const Vec2 p_W : order.points_W) {
    item.add(p_W.x);
    item.add(p_W.y);
  }
  item.add(order.yaw_rad ? std::uint64_t{1} : std::uint64_t{0});
  for (const double number :
       {order.yaw_rad.value_or(0), order.v_mps, order.w_radps, order.speed_mps}) {
    item.add(number);
  }
  // Only if they are there: what was recorded before keeps its hash.
  if (order.vy_mps != 0) item.add(order.vy_mps);
  if (order.pedals) {
    const request::Pedals& pedals = *order.pedals;
    for (const double number : {pedals.steering, pedals.throttle, pedals.brake, pedals.gear}) {
      item.add(number);
    }
  }
  item.add_bytes(std::as_bytes(std::span(order.text)));
  item.add_bytes(std::as_bytes(std::span(input.author.name)));
  hash.add(item);
  return {step, input.robot, kind, BodyId(), with_author(order_text(input), input.author)};
}

Status check_body_change(const ParameterChange& change) {
  const ParameterChange* const one[] = {&change};
  const auto checked = with_changes(body_params(), {}, one);
  if (!checked) return tl::unexpected(checked.error());
  return {};
}

std::string body_change_text(double scale_before, double scale_after) {
  return fmt::format("body.scale: {} -> {}", scale_before, scale_after);
}

tl::unexpected<Error> refused_change(const EngineSpec& spec, RobotId robot, std::string_view part,
                                     const Error& error) {
  Error named = error;
  named.message =
      fmt::format("robot `{}`, {}: {}", spec.robots[robot.value()].name, part, error.message);
  return tl::unexpected(std::move(named));
}

}  // namespace rave::sim
