// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::gui_server {

/// The page key in the body of `POST /ticket`, as its 65 bytes; see direct_line::Ticket. Errors:
/// kParse with what was expected.
[[nodiscard]] Result<std::string> parse_ticket_request(std::string_view body);

}  // namespace rave::gui_server
