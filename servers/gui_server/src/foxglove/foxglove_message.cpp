// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_message.hpp"

#include <algorithm>
#include <array>

#include "page/members.hpp"

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

Result<FoxgloveSubscription> subscription_of(const PageJson& json, const char* name) {
  if (!json.is_object()) {
    return fail(ErrorCode::kParse, "`{}`: expected objects with id and channelId", name);
  }
  Members members(json);
  FoxgloveSubscription subscription;
  RAVE_TRY_ASSIGN(subscription.id, members.index("id"));
  RAVE_TRY_ASSIGN(subscription.channel, members.index("channelId"));
  RAVE_TRY(members.finish());
  return subscription;
}

Result<FoxgloveMessage> subscribe_of(Members& members) {
  RAVE_TRY_ASSIGN(auto all, members.list("subscriptions", kMostSubscriptions, subscription_of));
  return FoxgloveSubscribe{std::move(all)};
}

Result<FoxgloveMessage> unsubscribe_of(Members& members) {
  RAVE_TRY_ASSIGN(auto ids, members.list("subscriptionIds", kMostSubscriptions, Members::index_of));
  return FoxgloveUnsubscribe{std::move(ids)};
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
