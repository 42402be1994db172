// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

namespace rave::control {

/// What a line of the control socket is, with its keys in the order of the line.
using Json = nlohmann::ordered_json;

/// An object without repeated keys; discarded for anything else.
[[nodiscard]] Json parse_line_object(std::string_view line);

}  // namespace rave::control
