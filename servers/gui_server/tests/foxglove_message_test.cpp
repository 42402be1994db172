// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_message.hpp"

#include <gtest/gtest.h>

#include "foxglove/foxglove_door.hpp"

namespace rave::gui_server {
namespace {

std::string error_of(std::string_view text) {
  const auto message = parse_foxglove_message(text);
  return message ? "" : message.error().message;
}

TEST(FoxgloveMessage, Subscribes) {
  const auto message = parse_foxglove_message(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":7,"channelId":5}]})");
  ASSERT_TRUE(message) << message.error().text();
  const auto& subscriptions = std::get<FoxgloveSubscribe>(*message).subscriptions;
  EXPECT_EQ(subscriptions, (std::vector<FoxgloveSubscription>{{0, 3}, {7, 5}}));
  const auto end = parse_foxglove_message(R"({"op":"unsubscribe","subscriptionIds":[7]})");
  ASSERT_TRUE(end) << end.error().text();
  EXPECT_EQ(std::get<FoxgloveUnsubscribe>(*end).ids, std::vector<std::uint32_t>{7});
}

TEST(FoxgloveMessage, KnowsWhatItRefuses) {
  for (const char* const op :
       {"advertise", "unadvertise", "getParameters", "setParameters", "subscribeParameterUpdates",
        "unsubscribeParameterUpdates", "subscribeConnectionGraph", "unsubscribeConnectionGraph",
        "fetchAsset"}) {
    const auto message =
        parse_foxglove_message(std::string(R"({"whatever":[1],"op":")") + op + "\"}");
    ASSERT_TRUE(message) << op;
    EXPECT_EQ(std::get<FoxgloveRefused>(*message).op, op);
  }
}

TEST(FoxgloveMessage, SaysWhatIsWrong) {
  EXPECT_EQ(error_of("[]"), "expected a JSON object");
  EXPECT_EQ(error_of("{"), "expected a JSON object");
  EXPECT_EQ(error_of("{}"), "`op` is missing");
  EXPECT_EQ(error_of(R"({"op":"drive"})"), "`op`: expected subscribe or unsubscribe");
  EXPECT_EQ(error_of(R"({"op":"subscribe"})"), "`subscriptions` is missing");
  EXPECT_EQ(error_of(R"({"op":"subscribe","subscriptions":[3]})"),
            "`subscriptions`: expected objects with id and channelId");
  EXPECT_EQ(error_of(R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})"),
            "`id`: expected a whole number from 0 to 4294967295");
  EXPECT_EQ(error_of(R"({"op":"subscribe","subscriptions":[{"id":1}]})"), "`channelId` is missing");
  EXPECT_EQ(error_of(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1,"x":1}]})"),
            "the message has unknown members");
  EXPECT_EQ(error_of(R"({"op":"unsubscribe","subscriptionIds":[1.5]})"),
            "`subscriptionIds`: expected a whole number from 0 to 4294967295");
  EXPECT_EQ(error_of(R"({"op":"unsubscribe","subscriptionIds":[],"x":1})"),
            "the message has unknown members");
  std::string many = R"({"op":"unsubscribe","subscriptionIds":[0)";
  for (std::size_t i = 0; i < kMostSubscriptions; ++i) many += ",0";
  EXPECT_EQ(error_of(many + "]}"), "`subscriptionIds`: expected an array of at most 2000");
}

TEST(FoxgloveOrigin, IsSchemeAndHost) {
  for (const char* const good : {"https://app.foxglove.dev", "http://localhost:8081", "file://",
                                 "https://[::1]:9", "vscode-webview://0a-b"}) {
    EXPECT_TRUE(check_foxglove_origin(good)) << good;
  }
  for (const char* const bad : {"", "null", "*", "https://", "app.foxglove.dev",
                                "https://app.foxglove.dev/", "https://App.foxglove.dev", "://a"}) {
    const auto checked = check_foxglove_origin(bad);
    ASSERT_FALSE(checked) << bad;
    EXPECT_NE(checked.error().message.find("is not an origin: expected scheme and host"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace rave::gui_server
