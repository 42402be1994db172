// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "line_json.hpp"
#include "rave/control/protocol.hpp"

namespace rave::control {

/// Takes the keys that belong to a request out of an object; false: one of them is missing,
/// has the wrong type or is beyond its bounds. What stays in the object does not belong there.
[[nodiscard]] bool take_request_fields(Json& json, Request& request);

}  // namespace rave::control
