// SPDX-License-Identifier: Apache-2.0
#include "visitors/ticket_request.hpp"

#include "rave/direct_line/json_members.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::gui_server {

Result<std::string> parse_ticket_request(std::string_view body) {
  constexpr std::size_t kLongest = 1000;
  const std::string_view text = body.size() <= kLongest ? body : "";
  RAVE_TRY_ASSIGN(const auto object, direct_line::JsonMembers::parse_object(text, "request"));
  direct_line::JsonMembers members(object);
  RAVE_TRY_ASSIGN(const std::string key, members.word("key"));
  RAVE_TRY(members.finish());
  return direct_line::page_key_of(key);
}

}  // namespace rave::gui_server
