// SPDX-License-Identifier: Apache-2.0
// Somebody without an account, or with one that has ended, tries to come in.
#include <gtest/gtest.h>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

TEST_F(Hostile, WhoIsRemovedIsOut) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  ASSERT_TRUE(accounts_->remove("eve"));
  EXPECT_EQ(eve.close_code(), 4401);
}

TEST_F(Hostile, LinksWorkOnce) {
  const std::string link = server_->entry();
  const std::string path = link.substr(link.find("/enter"));
  const std::string first = ask("GET", path);
  EXPECT_EQ(status_of(first), "303");
  EXPECT_NE(first.find("__Host-rave_"), std::string::npos);
  for (const char* const part : {"HttpOnly", "SameSite=Strict", "Secure", "Path=/"}) {
    EXPECT_NE(first.find(part), std::string::npos) << part;
  }
  const std::string second = ask("GET", path);
  EXPECT_EQ(status_of(second), "403");
  EXPECT_EQ(cookie_of(second), "");
  const auto invitation = accounts_->invite(Role::kObserver, {}, 1, 7, "test");
  EXPECT_EQ(status_of(ask("GET", "/join?invite=" + *invitation)), "200");
  const std::string form = "invite=" + *invitation + "&name=";
  EXPECT_EQ(status_of(ask("POST", "/join", origin(), form + "ben")), "303");
  EXPECT_EQ(status_of(ask("POST", "/join", origin(), form + "cleo")), "403");
  // A link in a picture of another page signs nobody out.
  EXPECT_EQ(status_of(ask("GET", "/logout", cookie_of(first))), "405");
  EXPECT_EQ(status_of(ask("POST", "/logout", cookie_of(first) + origin())), "303");
  EXPECT_EQ(socket(cookie_of(first)).close_code(), 4401);
}

TEST_F(Hostile, StrangersGetTheDoorAndNothingElse) {
  const std::string home = ask("GET", "/");
  EXPECT_EQ(status_of(home), "303");
  EXPECT_NE(home.find("Location: /login"), std::string::npos);
  const std::string login = ask("GET", "/login");
  EXPECT_EQ(status_of(login), "200");
  EXPECT_NE(login.find("Content-Security-Policy: default-src 'none'; style-src 'self';"),
            std::string::npos);
  EXPECT_NE(login.find("Referrer-Policy: same-origin\r\n"), std::string::npos);
  EXPECT_EQ(login.find("no-referrer"), std::string::npos);
  EXPECT_EQ(login.find("fake"), std::string::npos);
  EXPECT_EQ(login.find("<script"), std::string::npos);
  for (const char* const path : {"/recording", "/recording?x=1"}) {
    EXPECT_EQ(status_of(ask("GET", path)), "401") << path;
  }
  const std::string eve = guest(Role::kObserver, "eve");
  EXPECT_EQ(status_of(ask("GET", "/recording", eve)), "403");
  for (const char* const path : {"/../accounts/accounts", "/%2e%2e/accounts/accounts", "/assets/..",
                                 "/..%5caccounts", "/%00"}) {
    EXPECT_EQ(status_of(ask("GET", path, eve)), "400") << path;
  }
  for (const char* const path :
       {"/accounts", "/accounts/accounts", "//etc/passwd", "/audit.jsonl"}) {
    EXPECT_EQ(status_of(ask("GET", path, eve)), "404") << path;
  }
  EXPECT_EQ(status_of(ask("POST", "/", eve + origin())), "405");
  EXPECT_EQ(status_of(ask("DELETE", "/login", eve)), "405");
  EXPECT_EQ(socket("").close_code(), 4401);
  EXPECT_EQ(socket("Cookie: __Host-rave_1=feed\r\n").close_code(), 4401);
}

TEST_F(Hostile, OtherOriginsAndNamesAreRefused) {
  const std::string eve = guest(Role::kObserver, "eve");
  for (const std::string& foreign :
       {std::string("https://evil.example"), fmt::format("http://127.0.0.1:{}", server_->port()),
        std::string("null")}) {
    const std::string header = "Origin: " + foreign + "\r\n";
    EXPECT_EQ(status_of(ask("POST", "/login", header, "name=a&password=b")), "403") << foreign;
    const RawSocket refused(server_->port(), authority(), eve + header);
    EXPECT_EQ(status_of(refused.answer()), "403") << foreign;
  }
  RawClient client(server_->port(), authority());
  client.send("GET /login HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(status_of(client.read_all()), "421");
}

TEST_F(Hostile, MalformedOversizedAndTooMuchIsRefused) {
  const std::string eve = guest(Role::kObserver, "eve");
  EXPECT_EQ(status_of(ask("GET", "/", "X: " + std::string(70'000, 'x') + "\r\n")), "413");
  EXPECT_EQ(status_of(ask("POST", "/login", origin(), std::string(70'000, 'x'))), "413");
  EXPECT_EQ(status_of(ask("POST", "/login", origin(), std::string(9'000, 'x'))), "400");
  EXPECT_EQ(status_of(ask("POST", "/login", origin(), "name=%0a")), "400");
  RawSocket long_one = socket(eve);
  long_one.send(std::string(70'000, ' '));
  EXPECT_EQ(long_one.close_code(), 1009);
  RawSocket binary = socket(eve);
  binary.send("bytes", 2);
  EXPECT_EQ(binary.close_code(), 1003);
  RawSocket nonsense = socket(eve);
  for (int i = 0; i < 30; ++i) nonsense.send(R"({"type":"hack"})");
  EXPECT_EQ(nonsense.close_code(), 4400);
  RawSocket no_text = socket(eve);
  no_text.send("\xff");
  EXPECT_EQ(no_text.close_code(), 1007);
  RawSocket flood = socket(eve);
  for (int i = 0; i < 4000; ++i) flood.send(R"({"type":"ack","sequence":1})");
  EXPECT_EQ(flood.close_code(), 4429);
  // Others noticed nothing.
  RawSocket still = socket(eve);
  EXPECT_NE(still.text_with("\"roster\""), "");
}

TEST_F(Hostile, PasswordsCannotBeTriedOutAndAreNotWrittenDown) {
  ASSERT_TRUE(accounts_->add({"ada", Role::kCommander, {}}, "correct horse"));
  std::string last;
  int refused = 0;
  for (int i = 0; i < 40 && status_of(last) != "429"; ++i) {
    last = ask("POST", "/login", origin(), "name=ada&password=guess" + std::to_string(i));
    refused += status_of(last) == "403" ? 1 : 0;
  }
  EXPECT_GE(refused, 10);
  EXPECT_EQ(status_of(last), "429");
  // Not even the right one is looked at now.
  last = ask("POST", "/login", origin(), "name=ada&password=correct+horse");
  EXPECT_EQ(status_of(last), "429");
  EXPECT_TRUE(audited(R"("why":"password","user":"ada","from":"127.0.0.1")"));
  EXPECT_TRUE(audited("too many tries"));
  EXPECT_EQ(audit().find("guess"), std::string::npos);
}

TEST_F(Hostile, SignInAnswersInThePageAndEscapes) {
  ASSERT_TRUE(accounts_->add({"ada", Role::kCommander, {}}, "correct horse"));
  const std::string wrong =
      ask("POST", "/login", origin(), "name=%3Cscript%3E%22&password=wrong+horse");
  EXPECT_EQ(wrong.find("<script"), std::string::npos);
  EXPECT_NE(wrong.find("value=\"&lt;script&gt;&quot;\""), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("The name or the password is wrong."), std::string::npos);
  const std::string in = ask("POST", "/login", origin(), "name=ada&password=correct+horse");
  EXPECT_EQ(status_of(in), "303");
  RawSocket ada = socket(cookie_of(in));
  EXPECT_NE(ada.text_with("hello").find(R"("user":{"name":"ada","role":"commander"})"),
            std::string::npos);
  const std::string pasted =
      ask("POST", "/login", origin(), "name=https%3A%2F%2Fevil.example%2Fjoin%3Finvite%3Dfeed");
  EXPECT_NE(pasted.find("Location: /join?invite=feed\r\n"), std::string::npos) << pasted;
}

TEST_F(Hostile, WithoutTlsNothingIsSaid) {
  RawClient plain(server_->port(), {});
  plain.send("GET /login HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
  EXPECT_EQ(plain.read_all().find("HTTP"), std::string::npos);
  std::ofstream(folder_ / "other.pem") << "";
  ASSERT_TRUE(keys::make_web_keys({folder_ / "other", {"127.0.0.1"}, 10, 1'800'000'000}));
  EXPECT_FALSE(RawClient(server_->port(), folder_ / "other/authority.pem").good());
}

TEST_F(Hostile, MetricsNameNobody) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"roster\""), "");
  const std::string answer = ask("GET", "/metrics");
  EXPECT_EQ(status_of(answer), "200");
  EXPECT_NE(answer.find("\nrave_gui_pages 1\n"), std::string::npos) << answer;
  EXPECT_EQ(answer.find("eve"), std::string::npos);
}

TEST_F(Hostile, ListeningElsewhereNeedsTlsAndAccounts) {
  // A run is shown by one server at a time.
  server_.reset();
  const auto error = [this](const GuiOptions& options) {
    const auto started = GuiServer::start(options, run_);
    return started ? "none" : started.error().message;
  };
  GuiOptions open = options_;
  open.listen = "0.0.0.0";
  EXPECT_NE(error(open).find("has no super-user: `rave people add YOU --role super_user"),
            std::string::npos)
      << error(open);
  ASSERT_TRUE(accounts_->add({"ada", Role::kSuperUser, {}}, "correct horse"));
  EXPECT_EQ(error(open), "none");
  open.accounts.clear();
  EXPECT_NE(error(open).find("needs accounts: add --accounts"), std::string::npos);
  open.certificate.clear();
  EXPECT_NE(error(open).find("to listen on 0.0.0.0 needs TLS: `rave keys web web-keys NAME`"),
            std::string::npos);
}

}  // namespace
}  // namespace rave::gui_server::testing
