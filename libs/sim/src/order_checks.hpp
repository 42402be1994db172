// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/base/result.hpp"
#include "rave/robot/order.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/orders.hpp"
#include "rave/sim/world_input.hpp"

/// What can be said of an order without its robot's drivers: an engine and an authority say the
/// same.
namespace rave::sim {

/// Its kind; kNone: the input is no order.
[[nodiscard]] OrderKind order_kind(const WorldInput& input) noexcept;
/// What the order of an input consists of; nothing: it is no order. Valid as long as the input.
[[nodiscard]] request::OrderParts order_parts(const WorldInput& input) noexcept;

/// Whether it has the form of an order: numbers are finite, texts and lists have at most their
/// length. What another process says is looked at so before anything else.
[[nodiscard]] bool is_order_formed(const WorldInput& input) noexcept;

/// Whether an order may be given at all: numbers are finite and within their limits, texts have
/// their length, points are in the world, in no obstacle, and within the fence of the robot.
/// Errors: kInvalidArgument, with the name of the robot.
[[nodiscard]] Status check_order(const EngineSpec& spec, const WorldInput& input);

/// The pose that is asked for; without a yaw, the robot keeps `yaw_rad`.
[[nodiscard]] Pose2 ordered_place(const request::Place& place, double yaw_rad) noexcept;

/// The error of an order that was refused: with robot and kind.
[[nodiscard]] tl::unexpected<Error> refused_order(const EngineSpec& spec, const WorldInput& input,
                                                  ErrorCode code, std::string_view why);

}  // namespace rave::sim
