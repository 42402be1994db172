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

/// Why a path of so many points is not taken, in the same words wherever orders come in.
[[nodiscard]] std::string path_size_text(std::size_t points);

}  // namespace rave::sim
