// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/sim/engine_spec.hpp"

namespace rave::sim {

/// Whether a change is one of the robot's body, which only the authority can make.
[[nodiscard]] inline bool is_of_body(const ParameterChange& change) noexcept {
  return change.part == ParameterChange::Part::kBody;
}

/// What must hold for a spec on every host. Errors: kInvalidArgument.
Status check_world(const EngineSpec& spec);
/// What must hold of it, too, if several hosts share the world. Errors: kInvalidArgument.
Status check_shared(const EngineSpec& spec);
/// What must hold of robots with two sets of drivers. Errors: kInvalidArgument (the robots are
/// shared among hosts).
Status check_twins(const EngineSpec& spec);
/// What check_shared() says and EngineSpec::local; nothing if that is not set.
Status check_local(const EngineSpec& spec);

/// Whether the system gave the run all threads that it asked for. Error: kIo.
Status check_threads(const EngineSpec& spec, unsigned given);

/// Whether a robot of this type need not be armed before it moves.
[[nodiscard]] inline bool is_armed_at_first(const RobotType& type) noexcept {
  return type.simulated || !type.guard.value_or(GuardSpec{}).arm;
}

/// By robot: 1 if it runs here.
[[nodiscard]] std::vector<std::uint8_t> local_robots(const EngineSpec& spec);

}  // namespace rave::sim
