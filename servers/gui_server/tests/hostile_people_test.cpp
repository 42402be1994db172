// SPDX-License-Identifier: Apache-2.0
// Accounts, invitations and the audit log: of super-users alone, whatever others send.
#include <unistd.h>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

constexpr const char* kInvite =
    R"({"type":"invitation","request":1,"do":"make","role":"super_user","teams":"*","uses":9,"days":9})";

/// The member of a message that is a string; empty: it has none.
std::string member(const std::string& message, const std::string& name) {
  const std::string key = "\"" + name + "\":\"";
  const std::size_t at = message.find(key);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + key.size();
  return message.substr(begin, message.find('"', begin) - begin);
}

TEST_F(Hostile, RequestsAboutPeopleAreOfSuperUsersAlone) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  for (RawSocket* const client : {&eve, &ben}) {
    for (
        const char* const request :
        {R"({"type":"account","request":1,"do":"change","name":"eve","role":"super_user","teams":"*"})",
         R"({"type":"account","request":1,"do":"disable","name":"ben"})",
         R"({"type":"account","request":1,"do":"enable","name":"ben"})",
         R"({"type":"account","request":1,"do":"end_sessions","name":"ben"})", kInvite,
         R"({"type":"invitation","request":1,"do":"withdraw","id":"00"})",
         R"({"type":"audit","request":1,"most":1000})"}) {
      client->send(request);
      const std::string answer = client->text_with("\"type\":\"answer\"");
      EXPECT_NE(answer.find("Only a super-user can do this."), std::string::npos) << answer;
    }
    for (const char* const type :
         {"accounts", "invited", "audit_lines", "audit_written", "rights"}) {
      EXPECT_EQ(client->heard().find(fmt::format(R"("type":"{}")", type)), std::string::npos)
          << type;
    }
  }
  ASSERT_TRUE(accounts_->refresh());
  EXPECT_TRUE(accounts_->state().invitations.empty());
  for (const Account& account : accounts_->state().accounts) {
    EXPECT_FALSE(account.disabled);
    EXPECT_NE(account.person.role, Role::kSuperUser);
  }
  for (const char* const line : {R"("why":"account","user":"eve","detail":"change")",
                                 R"("why":"account","user":"ben","detail":"make")",
                                 R"("why":"account","user":"ben","detail":"audit")"}) {
    EXPECT_TRUE(audited(line)) << line;
  }
}

TEST_F(Hostile, ALinkIsToldOnceToWhoMadeIt) {
  RawSocket boss = super_user();
  RawSocket other = super_user();
  boss.send(kInvite);
  const std::string link = member(boss.text_with(R"("type":"invited")"), "link");
  ASSERT_TRUE(link.starts_with("/join?invite=")) << link;
  const std::string secret = link.substr(link.find('=') + 1);
  const std::string list = other.text_with(R"("invitations":[{)");
  EXPECT_NE(list.find(R"("by":"operator")"), std::string::npos) << list;
  // A second look, by either of them, has the list and not the link.
  boss.send(R"({"type":"see_as","role":"observer"})");
  boss.send(R"({"type":"see_as"})");
  EXPECT_NE(boss.text_with(R"("invitations":[{)"), "");
  boss.send(R"({"type":"audit","request":2,"most":10,"what":"invitation"})");
  const std::string lines = boss.text_with(R"("type":"audit_lines")");
  EXPECT_NE(lines.find("made: super_user, teams *, 9 uses, 9 days"), std::string::npos) << lines;
  const std::string& heard = boss.heard();
  EXPECT_EQ(heard.find(secret), heard.rfind(secret));
  EXPECT_EQ(other.heard().find(secret), std::string::npos);
  EXPECT_EQ(audit().find(secret), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", link)), "200");
  const std::string id = member(list.substr(list.find(R"("invitations")")), "id");
  boss.send(fmt::format(R"({{"type":"invitation","request":3,"do":"withdraw","id":"{}"}})", id));
  EXPECT_NE(boss.text_with(R"("to":"withdraw")").find(R"("good":true)"), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", link)), "403");
  EXPECT_NE(other.text_with(R"("invitations":[])"), "");
}

TEST_F(Hostile, WhoLosesTheRoleLosesItOnOpenPages) {
  RawSocket boss = super_user();
  RawSocket cleo = socket(guest(Role::kSuperUser, "cleo"));
  EXPECT_NE(cleo.text_with(R"("type":"accounts")").find(R"("name":"cleo","role":"super_user")"),
            std::string::npos);
  boss.send(
      R"({"type":"account","request":1,"do":"change","name":"cleo","role":"observer","teams":"green"})");
  EXPECT_NE(boss.text_with(R"("to":"change")").find(R"("good":true)"), std::string::npos);
  const std::string hello = cleo.text_with("\"hello\"");
  EXPECT_NE(hello.find(R"("user":{"name":"cleo","role":"observer"})"), std::string::npos) << hello;
  cleo.send(kInvite);
  EXPECT_NE(cleo.text_with(R"("to":"make")").find(R"("good":false)"), std::string::npos);
  // And back: the page is told what super-users are told.
  boss.send(
      R"({"type":"account","request":2,"do":"change","name":"cleo","role":"super_user","teams":"*"})");
  EXPECT_NE(cleo.text_with(R"("type":"rights")"), "");
  EXPECT_NE(cleo.text_with(R"("type":"accounts")"), "");
  // Nobody takes the role from themselves.
  cleo.send(R"({"type":"account","request":3,"do":"disable","name":"cleo"})");
  EXPECT_NE(cleo.text_with(R"("to":"disable")").find("your own role"), std::string::npos);
  boss.send(R"({"type":"account","request":4,"do":"disable","name":"cleo"})");
  EXPECT_EQ(cleo.close_code(), 4401);
  EXPECT_TRUE(audited("cleo: observer, teams green (was super_user, teams green)")) << audit();
  EXPECT_TRUE(audited(R"("detail":"cleo: disabled")"));
}

TEST_F(Hostile, SessionsThatAreEndedAreOut) {
  RawSocket boss = super_user();
  const std::string cookie = guest(Role::kObserver, "eve");
  RawSocket one = socket(cookie);
  RawSocket two = socket(cookie);
  EXPECT_NE(boss.text_with(R"("pages":2)").find(R"("name":"eve")"), std::string::npos);
  boss.send(R"({"type":"account","request":1,"do":"end_sessions","name":"eve"})");
  EXPECT_EQ(one.close_code(), 4401);
  EXPECT_EQ(two.close_code(), 4401);
  EXPECT_NE(boss.text_with(R"("to":"end_sessions")").find("eve: 1 session ended"),
            std::string::npos);
  boss.send(R"({"type":"account","request":2,"do":"end_sessions","name":"evee"})");
  EXPECT_NE(boss.text_with(R"("to":"end_sessions")").find(R"("good":false)"), std::string::npos);
}

TEST_F(Hostile, AServerWithoutAccountsSaysSo) {
  server_.reset();
  GuiOptions plain;
  plain.page = options_.page;
  plain.port = 0;
  auto started = GuiServer::start(plain, run_);
  ASSERT_TRUE(started) << started.error().text();
  const std::uint16_t port = (*started)->port();
  const std::string link = (*started)->entry();
  RawClient client(port, {});
  client.send(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\n\r\n",
                          link.substr(link.find("/enter")), port));
  const std::string cookie = cookie_of(client.read_all());
  RawSocket boss(port, {}, fmt::format("{}Origin: http://127.0.0.1:{}\r\n", cookie, port));
  const std::string told = boss.text_with(R"("type":"accounts")");
  EXPECT_NE(told.find(R"("kept":false,"why_not":"This server has no accounts)"), std::string::npos)
      << told;
  boss.send(kInvite);
  EXPECT_NE(boss.text_with(R"("to":"make")").find("--accounts DIR"), std::string::npos);
}

}  // namespace
}  // namespace rave::gui_server::testing
