// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// The messages of a page on a direct line. None of their content is trusted.
namespace rave::direct_line {

/// The first message of a page: its answer to the challenge.
struct HelloMessage {
  std::string ticket;
  std::string proof;  ///< The signature as bytes; see page_key.hpp.
};
/// Replaces the ticket by the next one before it expires.
struct RenewMessage {
  std::string ticket;
};
struct PingMessage {
  std::uint64_t id = 0;
};
/// `request` without its author.
struct OrderMessage {
  std::uint64_t id = 0;
  request::Request request;
  bool echo = false;  ///< Whether accepted drive commands are answered, too.
};
using LineMessage = std::variant<HelloMessage, RenewMessage, PingMessage, OrderMessage>;

/// Errors: kParse, with what was expected.
[[nodiscard]] Result<LineMessage> parse_line_message(std::string_view text);

}  // namespace rave::direct_line
