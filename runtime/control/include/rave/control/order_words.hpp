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

/// Requests in their three forms: as a value, as an input of a run, and as the text of a recording.
namespace rave::runtime {

/// Converts a stop, a release, an arming or an order to an input of the run, with its author.
/// Errors: kNotFound (no such robot), kInvalidArgument (it names none, or is another request).
[[nodiscard]] Result<sim::WorldInput> input_for(const sim::EngineSpec& spec,
                                                const request::Request& request);
/// The inverse of input_for().
[[nodiscard]] request::Request input_request(const sim::EngineSpec& spec,
                                             const sim::WorldInput& input);

/// Writes the names of the orders that a robot takes, such as `goal`; rewrites them only if they
/// changed.
void write_takes(OrderSet set, std::vector<std::string>& words);

/// The answer to an accepted order.
[[nodiscard]] std::string order_answer(const request::Request& request);

/// A request in the words of a recording.
struct RecordedWords {
  std::string kind;   ///< The name of the action.
  std::string key;    ///< Of a parameter.
  std::string value;  ///< What else the action has, see recorded_words().
};
/// Of an order the details in one line: `points 1.5 2 yaw 0.5 speed 0.2`, `v 0.3 w -0.1`, or its
/// text. Of an edit its JSON. Numbers are restored bit by bit.
[[nodiscard]] RecordedWords recorded_words(const request::Action& action);
/// The inverse, also of what older versions recorded. Error: kParse.
[[nodiscard]] Result<request::Action> recorded_action(const RecordedWords& words);

}  // namespace rave::runtime
