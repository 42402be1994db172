// SPDX-License-Identifier: Apache-2.0
#include "foxglove_message.hpp"

#include <algorithm>
#include <array>

#include "members.hpp"

namespace rave::gui_server {
namespace {

constexpr std::array<std::string_view, 9> kRefusedOps = {"advertise",
                                                         "unadvertise",
                                                         "getParameters",
                                                         "setParameters",
                                                         "subscribeParameterUpdates",
                                                         "unsubscribeParameterUpdates",
                                                         "subscribeConnectionGraph",
                                                         "unsubscribeConnectionGraph",
                                                         "fetchAsset"};

Result<FoxgloveMessage> subscribe_of(Members& members) {
  FoxgloveSubscribe subscribe;
  RAVE_TRY_ASSIGN(const PageJson* const all, members.array("subscriptions", kMostSubscriptions));
  for (const PageJson& one : *all) {
    if (!one.is_object()) {
      return fail(ErrorCode::kParse, "`subscriptions`: expected objects with id and channelId");
    }
    Members of_one(one);
    FoxgloveSubscription subscription;
    RAVE_TRY_ASSIGN(subscription.id, of_one.index("id"));
    RAVE_TRY_ASSIGN(subscription.channel, of_one.index("channelId"));
    RAVE_TRY(of_one.finish());
    subscribe.subscriptions.push_back(subscription);
  }
  return FoxgloveMessage(std::move(subscribe));
}

Result<FoxgloveMessage> unsubscribe_of(Members& members) {
  FoxgloveUnsubscribe unsubscribe;
  RAVE_TRY_ASSIGN(const PageJson* const all, members.array("subscriptionIds", kMostSubscriptions));
  for (const PageJson& one : *all) {
    RAVE_TRY_ASSIGN(const std::uint32_t id, Members::index_of(one, "subscriptionIds"));
    unsubscribe.ids.push_back(id);
  }
  return FoxgloveMessage(std::move(unsubscribe));
}

}  // namespace

Result<FoxgloveMessage> parse_foxglove_message(std::string_view text) {
  const PageJson json = PageJson::parse(text, nullptr, false);
  if (!json.is_object()) return fail(ErrorCode::kParse, "expected a JSON object");
  Members members(json);
  RAVE_TRY_ASSIGN(std::string op, members.word("op"));
  // What else such a request has does not matter: nothing of it is done.
  if (std::ranges::find(kRefusedOps, op) != kRefusedOps.end()) {
    return FoxgloveMessage(FoxgloveRefused{std::move(op)});
  }
  if (op != "subscribe" && op != "unsubscribe") {
    return fail(ErrorCode::kParse, "`op`: expected subscribe or unsubscribe");
  }
  auto message = op == "subscribe" ? subscribe_of(members) : unsubscribe_of(members);
  if (!message) return message;
  RAVE_TRY(members.finish());
  return message;
}

}  // namespace rave::gui_server
