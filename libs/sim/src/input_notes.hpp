// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/hash.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/obstacle_change.hpp"

/// How inputs of a run are written down, the same for engine and authority.
namespace rave::sim {

/// The event of an input that counts from `step` on; adds it to the hash.
[[nodiscard]] Event noted_input(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                                const Author& author, RunHash& hash);

/// The event of a change of an obstacle that was made, and counts from `step` on; adds it to the
/// hash, with all its numbers. `note`: what else is worth telling.
[[nodiscard]] Event noted_obstacle(std::uint64_t step, const ObstacleChange& change,
                                   std::string_view note, const Author& author, RunHash& hash);

/// The event of an order that counts from `step` on; adds it to the hash, with all its numbers.
[[nodiscard]] Event noted_order(std::uint64_t step, const WorldInput& input, EventKind kind,
                                RunHash& hash);

/// Whether the change of a body names what bodies have, with a value that it may have. Errors:
/// kNotFound, kInvalidArgument.
Status check_body_change(const ParameterChange& change);
[[nodiscard]] std::string body_change_text(double scale_before, double scale_after);

/// The error of a change that was refused, with robot and part.
[[nodiscard]] tl::unexpected<Error> refused_change(const EngineSpec& spec, RobotId robot,
                                                   std::string_view part, const Error& error);

}  // namespace rave::sim
