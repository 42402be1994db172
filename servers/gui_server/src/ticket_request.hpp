// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::gui_server {

/// The body of `POST /ticket`.
struct TicketRequest {
  std::string page_key;  ///< 65 bytes; see direct_line::Ticket.
};

/// A public key in base64url, as its 65 bytes. Error: kParse.
[[nodiscard]] Result<std::string> page_key_of(const std::string& text);

/// Errors: kParse with what was expected.
[[nodiscard]] Result<TicketRequest> parse_ticket_request(std::string_view body);

}  // namespace rave::gui_server
