// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/world_file.hpp"
#include "rave/control/run_control.hpp"
#include "rave/sim/obstacle_change.hpp"

// Edits of obstacles: as a request, as a change of the world, and in a recording. The struct and
// its text are config::ObstacleEdit and config::write_edit().
namespace rave::runtime {

/// The change of the world that an edit asks for, with its author. Errors: kParse and
/// kInvalidArgument, without a place in a file.
[[nodiscard]] Result<sim::ObstacleChange> requested_change(const config::ObstacleEdit& edit,
                                                           const std::string& by);

/// What an edit does, as an imperative: `add`, `move` or `remove`.
[[nodiscard]] std::string_view word_of(const config::ObstacleEdit& edit) noexcept;

/// The edit in a recorded input; nothing if the input is of another kind. Reads also the inputs
/// `add`, `move` and `remove` of earlier recordings, whose values are YAML. Error:
/// kParse.
[[nodiscard]] std::optional<Result<config::ObstacleEdit>> recorded_edit(std::string_view kind,
                                                                        std::string_view key,
                                                                        std::string_view value);

}  // namespace rave::runtime
