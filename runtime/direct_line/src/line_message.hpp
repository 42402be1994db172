// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// What a page says on a direct line. Nothing of it is trusted.
namespace rave::direct_line {

/// The first message, the answer to the challenge.
struct HelloMessage {
  std::string ticket;
  std::string proof;  ///< Bytes; see page_key.hpp.
};
/// The next ticket, before the first one ends.
struct RenewMessage {
  std::string ticket;
};
struct PingMessage {
  std::uint64_t id = 0;
};
/// `request` without its author.
struct OrderMessage {
  std::uint64_t id = 0;
  runtime::RunRequest request;
  bool echo = false;  ///< A drive that was accepted is answered, too.
};
using LineMessage = std::variant<HelloMessage, RenewMessage, PingMessage, OrderMessage>;

/// No faster than any robot; what is beyond is a mistake.
inline constexpr double kMostSpeed_mps = 100;
inline constexpr double kMostTurn_radps = 100;
inline constexpr double kFarthest_m = 1e6;
inline constexpr std::size_t kLongestText = 1000;

/// Errors: kParse with what was expected.
[[nodiscard]] Result<LineMessage> parse_line_message(std::string_view text);

}  // namespace rave::direct_line
