// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "line_json.hpp"
#include "rave/control/protocol.hpp"

namespace rave::control {

/// An answer as an object; its status only if that has a scenario.
[[nodiscard]] Json answer_json(const Answer& answer);

/// The inverse, with texts made plain. False: a member is missing or has the wrong type. What older
/// processes do not say may be missing.
[[nodiscard]] bool read_answer(const Json& json, Answer& answer);

/// Text of another process made safe for a terminal: control characters become spaces, except the
/// line ends of a list.
[[nodiscard]] std::string plain_text(std::string_view text);

}  // namespace rave::control
