// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/robot/order.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// The orders that robots of a type take while drivers and programs work; Engine::takes() gives the
/// orders that a robot takes now. A type without function tables takes fewer.
[[nodiscard]] OrderSet declared_orders(const RobotType& type) noexcept;

/// An order in words: `goal 1.20, 3.40`.
[[nodiscard]] std::string order_text(const WorldInput& input);

}  // namespace rave::sim
