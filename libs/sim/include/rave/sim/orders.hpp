// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/robot/order.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// Which orders robots of a type take as long as their drivers and programs work; see
/// Engine::takes() for those of a robot now. A type without function tables takes fewer.
[[nodiscard]] OrderSet declared_orders(const RobotType& type) noexcept;

/// An order for people: `goal 1.20, 3.40`.
[[nodiscard]] std::string order_text(const WorldInput& input);

}  // namespace rave::sim
