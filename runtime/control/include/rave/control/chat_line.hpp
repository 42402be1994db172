// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// Something that a person said to people, or to robots and the people who see them, on its way
/// into the record of a run.
struct ChatLine {
  std::uint64_t number = 0;  ///< Counts the lines of the server that it was said at, from 1 on.
  std::string from;          ///< 1 to kMostOrderAuthor bytes.
  std::string role;          ///< `observer`, `commander` or `super_user`.
  std::string to;            ///< `all`, `role`, `user`, `team` or `robot`.
  std::string name;          ///< Of whom `to` says; empty for `all`. At most kMostChatName bytes.
  std::string text;          ///< 1 to kMostOrderText bytes.
  friend bool operator==(const ChatLine&, const ChatLine&) = default;
};
inline constexpr std::size_t kMostChatName = 256;

/// A line as a request of the kind kChat.
[[nodiscard]] RunRequest chat_request(const ChatLine& line);
/// The same back. Error kInvalidArgument: what is wrong with it.
[[nodiscard]] Result<ChatLine> chat_line(const RunRequest& request);

}  // namespace rave::runtime
