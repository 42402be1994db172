// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/observe/kinds.hpp"

namespace rave::runtime {

/// The name of the robot of an event, or `world`.
[[nodiscard]] inline std::string_view subject_of(const sim::EngineSpec& spec,
                                                 const sim::Event& event) noexcept {
  return event.robot.valid() ? std::string_view(spec.robots[event.robot.value()].name) : "world";
}

}  // namespace rave::runtime
