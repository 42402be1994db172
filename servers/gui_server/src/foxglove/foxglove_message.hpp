// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rave/base/result.hpp"

// What a Foxglove client says: text messages of its WebSocket protocol. Plain values.
namespace rave::gui_server {

/// The most subscriptions that one message may name.
inline constexpr std::size_t kMostSubscriptions = 2000;

struct FoxgloveSubscription {
  std::uint32_t id = 0;       ///< The client's own number.
  std::uint32_t channel = 0;  ///< As it was advertised.
  friend bool operator==(const FoxgloveSubscription&, const FoxgloveSubscription&) = default;
};

struct FoxgloveSubscribe {
  std::vector<FoxgloveSubscription> subscriptions;
};

struct FoxgloveUnsubscribe {
  std::vector<std::uint32_t> ids;
};

/// A request that the protocol has and a server that is only read refuses: publishing, services,
/// parameters, assets, the graph of connections.
struct FoxgloveRefused {
  std::string op;  ///< One of the protocol.
};

using FoxgloveMessage = std::variant<FoxgloveSubscribe, FoxgloveUnsubscribe, FoxgloveRefused>;

/// Reads a text message. Strict: members that the protocol does not have are refused. Error kParse
/// with what was expected.
[[nodiscard]] Result<FoxgloveMessage> parse_foxglove_message(std::string_view text);

}  // namespace rave::gui_server
