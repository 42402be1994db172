// SPDX-License-Identifier: Apache-2.0
// Orders come from people and from other processes, so their numbers, texts and places are checked
// before anything is done. Both the engine and the authority use these checks.
#include "order_checks.hpp"

#include <algorithm>
#include <cmath>

#include "guard_fence.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/math/finite.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/orders.hpp"

namespace rave::sim {
namespace {

constexpr double kFastest_mps = 100;
constexpr double kFastest_radps = 100;
constexpr double kMostPlaceTurn_rad = 1e6;
/// The least distance by which the world extends beyond everything in it.
constexpr double kWorldMargin_m = 10;

/// What everything of a world is in.
struct Box {
  Vec2 low{1e300, 1e300};
  Vec2 high{-1e300, -1e300};
  void add(Vec2 middle, double radius_m) {
    low = {std::min(low.x, middle.x - radius_m), std::min(low.y, middle.y - radius_m)};
    high = {std::max(high.x, middle.x + radius_m), std::max(high.y, middle.y + radius_m)};
  }
};

/// Where robots may be sent: the box of all bodies, and around it as much again, at least 10 m.
Box world_box(const EngineSpec& spec) {
  Box box;
  const world::WorldModel& world = spec.world;
  for (std::size_t i = 0; i < world.obstacle_count(); ++i) {
    const world::Obstacle& obstacle = *world.obstacle(world.obstacle_id(i));
    if (!obstacle.removed) box.add(obstacle.X_WB.position(), obstacle.body.radius_m());
  }
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    box.add(spec.robots[r].X_WR.position(), world.robots[r].radius_m());
  }
  const double margin_m =
      std::max({kWorldMargin_m, box.high.x - box.low.x, box.high.y - box.low.y});
  box.add(box.low, margin_m);
  box.add(box.high, margin_m);
  return box;
}

/// Heights that a body fills.
std::pair<double, double> heights_of(const world::Body& body) {
  std::pair heights{1e300, -1e300};
  for (const world::Shape& shape : body.shapes) {
    heights = {std::min(heights.first, shape.z0_m), std::max(heights.second, shape.z1_m)};
  }
  return heights;
}

bool covers(const world::Body& body, Vec2 p_B, double z0_m, double z1_m) {
  return std::any_of(body.shapes.begin(), body.shapes.end(), [&](const world::Shape& shape) {
    if (shape.z1_m <= z0_m || shape.z0_m >= z1_m) return false;
    if (shape.polygon) return shape.polygon->contains(p_B);
    return squared_norm(p_B - shape.centre) <= shape.radius_m * shape.radius_m;
  });
}

/// The obstacle that a point is in, at the heights of a robot; null: none.
const world::Obstacle* obstacle_at(const world::WorldModel& world, const world::Body& robot,
                                   Vec2 p_W) {
  const auto [z0_m, z1_m] = heights_of(robot);
  for (std::size_t i = 0; i < world.obstacle_count(); ++i) {
    const world::Obstacle& obstacle = *world.obstacle(world.obstacle_id(i));
    const double radius_m = obstacle.body.radius_m();
    if (obstacle.removed ||
        squared_norm(p_W - obstacle.X_WB.position()) > radius_m * radius_m + 1e-9) {
      continue;
    }
    // A point and not the body of the robot: how near it can come is found out by driving there.
    if (covers(obstacle.body, transform_back(obstacle.X_WB, p_W), z0_m, z1_m)) return &obstacle;
  }
  return nullptr;
}

tl::unexpected<Error> wrong(const EngineSpec& spec, const WorldInput& input,
                            const std::string& what) {
  return refused_order(spec, input, ErrorCode::kInvalidArgument, what);
}

Status check_point(const EngineSpec& spec, const WorldInput& input, const Box& box, Vec2 p_W) {
  if (!is_finite(p_W)) {
    return wrong(spec, input,
                 fmt::format("({}, {}) is not a point; expected metres", p_W.x, p_W.y));
  }
  // A slip of the decimal point would otherwise send a robot away for good.
  if (p_W.x < box.low.x || p_W.x > box.high.x || p_W.y < box.low.y || p_W.y > box.high.y) {
    return wrong(spec, input,
                 fmt::format("({:.2f}, {:.2f}) is outside the world; expected x from {:.2f} to "
                             "{:.2f} m, y from {:.2f} to {:.2f} m",
                             p_W.x, p_W.y, box.low.x, box.high.x, box.low.y, box.high.y));
  }
  if (input.is<request::Place>()) return {};  // there its whole body is looked at
  const std::uint32_t r = input.robot.value();
  if (const auto* const obstacle = obstacle_at(spec.world, spec.world.robots[r], p_W)) {
    return wrong(spec, input,
                 fmt::format("({:.2f}, {:.2f}) is inside the obstacle `{}`", p_W.x, p_W.y,
                             obstacle->body.name));
  }
  const auto& guard = spec.types[spec.robots[r].type].guard;
  if (guard && !guard->fence_W.empty() && inside_distance(guard->fence_W, p_W) < 0) {
    return wrong(spec, input,
                 fmt::format("({:.2f}, {:.2f}) is outside the fence of the robot", p_W.x, p_W.y));
  }
  return {};
}

Status check_points(const EngineSpec& spec, const WorldInput& input) {
  const request::OrderParts order = order_parts(input);
  if (input.is<request::Path>()) {
    const Status size = request::check_path_size(order.points_W.size());
    if (!size) return wrong(spec, input, size.error().message);
  }
  // Of the world as it is now: obstacles may have come or gone since the start.
  const Box box = world_box(spec);
  for (const Vec2 p_W : order.points_W) RAVE_TRY(check_point(spec, input, box, p_W));
  const double yaw_rad = order.yaw_rad.value_or(0);
  if (!(std::abs(yaw_rad) <= kMostPlaceTurn_rad)) {
    return wrong(spec, input, fmt::format("{} is not a yaw; expected radians", yaw_rad));
  }
  const double speed_mps = order.speed_mps;
  if (!(speed_mps >= 0 && speed_mps <= kFastest_mps)) {
    return wrong(spec, input,
                 fmt::format("{} is not a speed; expected 0 to {} m/s", speed_mps, kFastest_mps));
  }
  return {};
}

}  // namespace

OrderSet declared_orders(const RobotType& type) noexcept {
  OrderSet set = type.simulated ? order_bit(OrderKind::kPlace) : 0;
  for (const ControllerSpec& controller : type.controllers) {
    const bool drives =
        controller.accepts == CommandKind::kVelocity || controller.accepts == CommandKind::kPedals;
    if (drives) set |= order_bit(OrderKind::kDrive);
    if (controller.accepts == CommandKind::kGoal) set |= order_bit(OrderKind::kGoal);
  }
  if (type.program) set |= type.program->takes();
  return set;
}

OrderKind order_kind(const WorldInput& input) noexcept {
  const auto* const order = input.as<request::Order>();
  return order != nullptr ? request::order_kind(*order) : OrderKind::kNone;
}

request::OrderParts order_parts(const WorldInput& input) noexcept {
  return request::parts_of(input.as<request::Order>());
}

// What another process may send at all. Whether an order makes sense is check_order(), whose errors
// are for people.
bool is_order_formed(const WorldInput& input) noexcept {
  const request::OrderParts order = order_parts(input);
  bool formed = input.is<request::Order>() && order.text.size() <= kMostOrderText &&
                order.points_W.size() <= kMostOrderPoints &&
                input.author.name.size() <= kMostOrderAuthor;
  for (const Vec2 p_W : order.points_W) formed = formed && is_finite(p_W);
  for (const double number :
       {order.yaw_rad.value_or(0), order.v_mps, order.w_radps, order.vy_mps, order.speed_mps}) {
    formed = formed && std::isfinite(number);
  }
  formed = formed && (!order.pedals || order.pedals->is_valid());
  return formed && (!input.is<request::Path>() || order.points_W.size() >= 2);
}

namespace {

Status check_drive(const EngineSpec& spec, const WorldInput& input, const request::Drive& drive) {
  if (drive.pedals && !drive.pedals->is_valid()) {
    return wrong(
        spec, input,
        "expected a steering from -1 to 1, throttle and brake from 0 to 1, gear -1, 0 or 1");
  }
  if (std::abs(drive.v_mps) <= kFastest_mps && std::abs(drive.w_radps) <= kFastest_radps &&
      std::abs(drive.vy_mps) <= kFastest_mps) {
    return {};
  }
  return wrong(
      spec, input,
      fmt::format("{} m/s, {} rad/s, {} m/s sideways: expected at most {} m/s and {} rad/s",
                  drive.v_mps, drive.w_radps, drive.vy_mps, kFastest_mps, kFastest_radps));
}

Status check_text(const EngineSpec& spec, const WorldInput& input, const std::string& text) {
  if (text.empty() || text.size() > kMostOrderText) {
    return wrong(spec, input,
                 fmt::format("{} bytes; expected 1 to {}", text.size(), kMostOrderText));
  }
  if (has_control_characters(text)) {
    return wrong(spec, input, "it has control characters; expected a line of plain text");
  }
  return {};
}

}  // namespace

Status check_order(const EngineSpec& spec, const WorldInput& input) {
  const std::string& name = input.author.name;
  if (name.size() > kMostOrderAuthor || has_control_characters(name)) {
    return fail(ErrorCode::kInvalidArgument,
                "the name of the author has {} bytes, or control characters; expected at most {}",
                name.size(), kMostOrderAuthor);
  }
  // Only a cancellation may be meant for all robots: all of them cannot go to one place.
  const bool cancel = input.is<request::Cancel>();
  const bool for_all = cancel && !input.robot.valid();
  if (!for_all && input.robot.value() >= spec.robots.size()) {
    return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot", to_string(order_kind(input)));
  }
  if (const auto* const drive = input.as<request::Drive>()) return check_drive(spec, input, *drive);
  if (const auto* const text = input.as<request::Text>()) {
    return check_text(spec, input, text->text);
  }
  if (cancel) return {};
  if (input.is<request::Order>()) return check_points(spec, input);
  return fail(ErrorCode::kInvalidArgument, "the input is not an order");
}

std::string order_text(const WorldInput& input) {
  const request::OrderParts order = order_parts(input);
  std::string text(to_string(order_kind(input)));
  if (const auto* const drive = input.as<request::Drive>()) {
    text += fmt::format(" {:.2f} m/s, {:.2f} rad/s", drive->v_mps, drive->w_radps);
    if (drive->vy_mps != 0) text += fmt::format(", {:.2f} m/s to the left", drive->vy_mps);
    if (const auto& pedals = drive->pedals) {
      text += fmt::format(", steering {:.2f}, throttle {:.2f}, brake {:.2f}, gear {}",
                          pedals->steering, pedals->throttle, pedals->brake, pedals->gear);
    }
    return text;
  }
  if (const auto* const words = input.as<request::Text>()) return text + ": " + words->text;
  if (input.is<request::Path>()) text += fmt::format(" of {} points to", order.points_W.size());
  if (!order.points_W.empty()) {
    const Vec2 last = order.points_W.back();
    text += fmt::format(" {:.2f}, {:.2f}", last.x, last.y);
  }
  if (order.yaw_rad) text += fmt::format(", yaw {:.0f} deg", rad_to_deg(*order.yaw_rad));
  return text;
}

Pose2 ordered_place(const request::Place& place, double yaw_rad) noexcept {
  return {place.p_W.x, place.p_W.y, wrap_angle(place.yaw_rad.value_or(yaw_rad))};
}

tl::unexpected<Error> refused_order(const EngineSpec& spec, const WorldInput& input, ErrorCode code,
                                    std::string_view why) {
  return fail(code, "robot `{}`, {}: {}", spec.robots[input.robot.value()].name,
              to_string(order_kind(input)), why);
}

}  // namespace rave::sim
