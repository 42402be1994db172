// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// A chat message to users, or to robots and the users who see them, for the recording of a run.
struct ChatLine {
  std::uint64_t number = 0;  ///< Number of the message at its server, from 1.
  std::string from;          ///< The sender; 1 to kMostOrderAuthor bytes.
  std::string role;          ///< Role of the sender: `observer`, `commander` or `super_user`.
  std::string to;            ///< Kind of receiver: `all`, `role`, `user`, `team` or `robot`.
  std::string name;  ///< Name of the receiver; empty for `all`. At most kMostChatName bytes.
  std::string text;  ///< 1 to kMostOrderText bytes.
  friend bool operator==(const ChatLine&, const ChatLine&) = default;
};
inline constexpr std::size_t kMostChatName = 256;

/// A chat message as a request of kind kChat.
[[nodiscard]] RunRequest chat_request(const ChatLine& line);
/// The inverse of chat_request(). Error kInvalidArgument.
[[nodiscard]] Result<ChatLine> chat_line(const RunRequest& request);

}  // namespace rave::runtime
