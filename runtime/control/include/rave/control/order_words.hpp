// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/robot/order.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/world_input.hpp"

/// Orders in their three forms: as a request, as an input of a run, and as the text of a recording.
namespace rave::runtime {

/// Checks the number of points of a path: 2 to kMostOrderPoints. Error: kInvalidArgument.
[[nodiscard]] Status check_path_size(std::size_t points);

/// Whether a request is an order: kDrive to kPlace.
[[nodiscard]] constexpr bool is_order(RunRequest::Kind kind) noexcept {
  return kind >= RunRequest::Kind::kDrive && kind <= RunRequest::Kind::kPlace;
}

/// What a stop, a release, an arming or an order is as an input. Error kInvalidArgument: a goal or
/// a place without its point.
[[nodiscard]] Result<sim::WorldInput::Action> input_action(const RunRequest& request);

/// Converts a request to an input of the run, with its author. Errors: kNotFound (no such robot),
/// kInvalidArgument (it names none).
[[nodiscard]] Result<sim::WorldInput> order_input(const sim::EngineSpec& spec,
                                                  const RunRequest& request);
/// The inverse, also for a stop, a release and an arming.
[[nodiscard]] RunRequest input_request(const sim::EngineSpec& spec, const sim::WorldInput& input);

/// Writes the names of the orders that a robot takes, such as `goal`; rewrites them only if they
/// changed.
void write_takes(OrderSet set, std::vector<std::string>& words);

/// The answer to an accepted order.
[[nodiscard]] std::string order_answer(const RunRequest& request);

/// The details of an order in one line, as in a recording: `points 1.5 2 yaw 0.5 speed 0.2`, `v 0.3
/// w -0.1`, or the text of kText. Numbers are restored bit by bit.
[[nodiscard]] std::string order_words(const RunRequest& request);
/// Parses order_words() into a request of a known kind. Error: kParse.
Status read_order_words(std::string_view words, RunRequest& request);

}  // namespace rave::runtime
