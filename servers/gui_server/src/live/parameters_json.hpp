// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/sim/engine_spec.hpp"

namespace rave::gui_server {

/// The array `robots` of a roster with the parameters of each robot that can be changed while it
/// runs, and what its second set of drivers is. Of more than 256 robots none are sent: a page would
/// get megabytes without use.
[[nodiscard]] std::string with_parameters(const std::string& robots_json,
                                          const sim::EngineSpec& spec);

/// A parameter with its default, as a message `catalogue` has it; also lists of numbers.
[[nodiscard]] std::string described_json(const ParamSpec& spec);

}  // namespace rave::gui_server
