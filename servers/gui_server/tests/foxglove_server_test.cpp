// SPDX-License-Identifier: Apache-2.0
// A whole server, and Foxglove clients with and without the rights to what they ask for.
#include "hostile_fixture.hpp"
#include "rave/gui_testing/foxglove_client.hpp"

namespace rave::gui_server::testing {
namespace {

using Json = nlohmann::ordered_json;

class Foxglove : public Hostile {
 protected:
  Foxglove() {
    options_.foxglove = true;
    options_.foxglove_origins = {"https://app.foxglove.dev", "file://"};
  }
  /// Path and query of an address.
  [[nodiscard]] static std::string target_of(const std::string& text) {
    const std::size_t at = text.find("/foxglove?token=");
    return at == std::string::npos ? "" : text.substr(at, text.find_first_of(" \n\r", at) - at);
  }
  [[nodiscard]] std::string operator_target() const {
    return target_of(server_->foxglove_address());
  }
  /// That of somebody who is signed in.
  [[nodiscard]] std::string target_for(const std::string& cookie) {
    return target_of(ask("GET", "/foxglove", cookie));
  }
  [[nodiscard]] FoxgloveClient client(const std::string& target, const std::string& headers = {},
                                      std::string_view protocols = "foxglove.websocket.v1") const {
    return {server_->port(), authority(), target, headers, protocols};
  }
};

TEST_F(Foxglove, LetsInByTokenAndListedOriginAlone) {
  const std::string good = operator_target();
  ASSERT_EQ(good.size(), std::string("/foxglove?token=").size() + 48);
  EXPECT_TRUE(server_->foxglove_address().starts_with("wss://127.0.0.1:"));
  EXPECT_EQ(client(good).status(), "101");
  EXPECT_EQ(client(good, "Origin: https://app.foxglove.dev\r\n").status(), "101");
  EXPECT_EQ(client(good, "Origin: file://\r\n").status(), "101");
  EXPECT_EQ(client(good, "Origin: https://evil.example\r\n").status(), "403");
  EXPECT_EQ(client(good, "Origin: null\r\n").status(), "403");
  EXPECT_EQ(client("/foxglove").status(), "401");
  std::string wrong = good;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  EXPECT_EQ(client(wrong).status(), "401");
  // A cookie is no token: browsers send it for pages of others, too.
  const std::string ada = guest(Role::kObserver, "ada");
  EXPECT_EQ(client("/foxglove", ada).status(), "401");
  EXPECT_EQ(client("/foxglove/x" + good.substr(9)).status(), "404");
  EXPECT_TRUE(audited("foxglove origin"));
  EXPECT_TRUE(audited("foxglove token"));
  EXPECT_EQ(audit().find(good.substr(good.find('=') + 1)), std::string::npos);
}

TEST_F(Foxglove, AgreesOnTheProtocol) {
  const std::string target = operator_target();
  const auto agreed = [&](std::string_view protocols) {
    FoxgloveClient one = client(target, {}, protocols);
    const std::string& answer = one.socket().answer();
    const std::size_t at = answer.find("Sec-WebSocket-Protocol: ");
    if (at == std::string::npos) return one.status();
    return answer.substr(at + 24, answer.find('\r', at) - at - 24);
  };
  EXPECT_EQ(agreed("foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(agreed("foxglove.sdk.v1, foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(agreed("rave.gui.1"), "400");
}

TEST_F(Foxglove, ShowsTheRun) {
  FoxgloveClient one = client(operator_target());
  const Json info = one.next("serverInfo");
  ASSERT_TRUE(info.is_object());
  EXPECT_EQ(info.at("capabilities").dump(), R"(["time"])");
  ASSERT_TRUE(one.subscribe("/tf", 1));
  ASSERT_TRUE(one.subscribe("/scene", 2));
  ASSERT_TRUE(one.subscribe("/robots", 3));
  const Json scene = one.data(2);
  ASSERT_EQ(scene.at("entities").size(), 2U);
  EXPECT_EQ(scene["deletions"][0].at("type"), 1);
  EXPECT_EQ(scene["entities"][0].at("cylinders")[0].at("pose").at("position").at("x"), 4321.5);
  const Json robots = one.data(3);
  ASSERT_EQ(robots.at("entities").size(), 4U);
  EXPECT_EQ(robots["entities"][1].at("frame_id"), "robot/spy-2");
  const Json transforms = one.data(1).at("transforms");
  ASSERT_EQ(transforms.size(), 4U);
  EXPECT_EQ(transforms[0].at("child_frame_id"), "robot/walker-1");
  EXPECT_EQ(transforms[0].at("translation").at("x"), 1.0);
  EXPECT_EQ(transforms[1].at("translation").at("x"), FakeRun::kSecretX_m);
  EXPECT_GT(one.time_ns, 0U);
  EXPECT_GE(one.clock_ns, one.time_ns);
  ASSERT_TRUE(one.subscribe("/scan/spy-2/scan", 4));
  EXPECT_EQ(one.data(4).at("frame_id"), "robot/spy-2");
  ASSERT_TRUE(one.subscribe("/log", 5));
  for (int i = 0; i < 3; ++i) static_cast<void>(one.data(5));
  EXPECT_EQ(one.data(5).at("message"), "walker-1: at home");
  ASSERT_TRUE(one.subscribe("/run", 6));
  EXPECT_EQ(one.data(6).at("state"), "running");
}

TEST_F(Foxglove, EndsSubscriptionsAndRefusesOddOnes) {
  FoxgloveClient one = client(operator_target());
  ASSERT_TRUE(one.subscribe("/tf", 1));
  ASSERT_TRUE(one.data(1).is_object());
  ASSERT_TRUE(one.subscribe("/tf", 2));
  EXPECT_EQ(one.next("status").at("message"),
            "subscription 2: this number or channel is already subscribed");
  one.socket().send(R"({"op":"subscribe","subscriptions":[{"id":9,"channelId":999}]})");
  EXPECT_EQ(one.next("status").at("message"), "there is no channel 999");
  one.socket().send(R"({"op":"unsubscribe","subscriptionIds":[1,3]})");
  EXPECT_EQ(one.next("status").at("message"), "there is no subscription 3");
  ASSERT_TRUE(one.subscribe("/poses", 4));
  const std::size_t before = one.socket().heard().size();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(one.data(4).is_object());
  EXPECT_EQ(one.socket().heard().find("parent_frame_id\":\"world", before), std::string::npos);
}

TEST_F(Foxglove, OnlyLooks) {
  FoxgloveClient one = client(operator_target());
  const auto refusal = [&](std::string_view bytes, int opcode) {
    one.socket().send(bytes, opcode);
    const Json status = one.next("status");
    return status.is_object() && status.at("level") == 2 ? status.at("message").get<std::string>()
                                                         : "";
  };
  EXPECT_EQ(refusal(R"({"op":"advertise","channels":[{"id":1,"topic":"/cmd"}]})", 1),
            "read-only: `advertise` is refused");
  EXPECT_EQ(refusal(std::string("\x01\0\0\0\0{}", 7), 2),
            "read-only: clients cannot publish, and there are no services");
  EXPECT_EQ(refusal(R"({"op":"setParameters","parameters":[]})", 1),
            "read-only: `setParameters` is refused");
  EXPECT_EQ(refusal(R"({"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1})", 1),
            "read-only: `fetchAsset` is refused");
  // Nor is it a page: what those may ask is nothing here.
  EXPECT_EQ(refusal(R"({"type":"halt","do":"stop","slots":[]})", 1), "`op` is missing");
  EXPECT_EQ(run_->halted_robots, 0);
  EXPECT_TRUE(run_->commands().empty());
  for (int i = 0; i < 200; ++i) one.socket().send("nonsense");
  EXPECT_EQ(one.socket().close_code(), 4400);
}

TEST_F(Foxglove, GivesNothingThatIsWithheld) {
  const std::string ada = guest(Role::kObserver, "ada");
  FoxgloveClient one = client(target_for(ada));
  ASSERT_EQ(one.status(), "101");
  ASSERT_TRUE(one.subscribe("/tf", 1));
  ASSERT_TRUE(one.subscribe("/scene", 2));
  ASSERT_TRUE(one.subscribe("/robots", 3));
  ASSERT_TRUE(one.subscribe("/log", 4));
  ASSERT_TRUE(one.subscribe("/poses", 5));
  // All channels there are, and some that others have.
  for (std::uint32_t channel = 0; channel < 30; ++channel) {
    one.socket().send(
        fmt::format(R"({{"op":"subscribe","subscriptions":[{{"id":{},"channelId":{}}}]}})",
                    100 + channel, channel));
  }
  const Json scene = one.data(2);
  ASSERT_EQ(scene.at("entities").size(), 1U);
  for (int i = 0; i < 20; ++i) {
    const Json transforms = one.data(1).at("transforms");
    ASSERT_EQ(transforms.size(), 2U);
    EXPECT_EQ(transforms[1].at("child_frame_id"), "robot/walker-3");
  }
  const std::string& heard = one.socket().heard();
  for (const char* const secret : {"spy", "blue", "secret", "pond", "4321", "7777", "1234.5"}) {
    EXPECT_EQ(heard.find(secret), std::string::npos) << secret;
  }
  EXPECT_EQ(one.channels.count("/scan/spy-2/scan"), 0U);
}

TEST_F(Foxglove, FollowsRightsAndSessions) {
  const std::string ada = guest(Role::kObserver, "ada");
  const std::string target = target_for(ada);
  EXPECT_EQ(target_for(ada), target);
  EXPECT_NE(target, operator_target());
  EXPECT_EQ(status_of(ask("GET", "/foxglove")), "401");
  FoxgloveClient one = client(target);
  ASSERT_TRUE(one.subscribe("/scene", 1));
  ASSERT_EQ(one.data(1).at("entities").size(), 1U);
  RawSocket boss = super_user();
  set_right(boss, "observer", "obstacles", "\"all\"");
  ASSERT_FALSE(one.next("unadvertise").is_null());
  ASSERT_TRUE(one.subscribe("/scene", 2));
  EXPECT_EQ(one.data(2).at("entities").size(), 2U);
  // Signed out with the page, signed out here.
  EXPECT_EQ(status_of(ask("POST", "/logout", ada + origin())), "303");
  EXPECT_EQ(one.socket().close_code(), 4401);
  EXPECT_EQ(client(target).status(), "401");
}

TEST_F(Foxglove, TurnsToTheNextRun) {
  FoxgloveClient one = client(operator_target());
  ASSERT_TRUE(one.subscribe("/tf", 1));
  ASSERT_TRUE(one.data(1).is_object());
  const std::uint32_t before = one.channels.at("/tf");
  server_->show(std::make_shared<FakeRun>());
  ASSERT_FALSE(one.next("unadvertise").is_null());
  ASSERT_TRUE(one.subscribe("/tf", 2));
  EXPECT_GT(one.channels.at("/tf"), before);
  EXPECT_TRUE(one.data(2).is_object());
}

/// Without the option nothing of it is there.
TEST_F(Hostile, FoxgloveIsNotThereUnlessAskedFor) {
  EXPECT_EQ(server_->foxglove_address(), "");
  EXPECT_EQ(status_of(ask("GET", "/foxglove", guest(Role::kObserver, "ada"))), "404");
  EXPECT_EQ(FoxgloveClient(server_->port(), authority(), "/foxglove?token=a").status(), "404");
}

}  // namespace
}  // namespace rave::gui_server::testing
