// SPDX-License-Identifier: Apache-2.0
// One visitor takes all that there is. Others come in all the same, from the same address.
#include <deque>

#include "hostile_fixture.hpp"

namespace rave::gui_server::testing {
namespace {

class HostileCrowd : public Hostile {
 protected:
  /// A super-user comes in anew, ten times, and stops everything; so does a commander.
  void expect_room() {
    for (int i = 0; i < 10; ++i) {
      RawSocket boss = super_user();
      EXPECT_NE(boss.text_with("\"roster\""), "") << boss.answer();
    }
    RawSocket ben = socket(guest(Role::kCommander, fmt::format("ben{}", ++guests_)));
    const int before = run_->halted_robots;
    ben.send(R"({"type":"halt","do":"stop","slots":[]})");
    EXPECT_NE(ben.text_with("\"to\":\"stop\"").find("\"good\":true"), std::string::npos);
    EXPECT_GT(run_->halted_robots, before);
  }
  int guests_ = 0;
};

TEST_F(HostileCrowd, OfPagesOfOneSessionKeepsNobodyOut) {
  const std::string eve = guest(Role::kObserver, "eve");
  std::deque<RawSocket> pages;
  for (int i = 0; i < 32; ++i) {
    EXPECT_NE(pages.emplace_back(socket(eve)).text_with("\"hello\""), "") << i;
  }
  EXPECT_EQ(socket(eve).close_code(), 4430);
  // More are as little in the way, although these do not even answer that.
  for (int i = 0; i < 200; ++i) pages.emplace_back(socket(eve));
  expect_room();
  EXPECT_TRUE(audited(R"("why":"too many pages of this session are open","user":"eve")"));
  // The pages that were there first are not disturbed.
  pages.front().send(R"({"type":"order","request":7,"kind":"cancel","slots":[0]})");
  EXPECT_NE(pages.front().text_with("\"request\":7"), "");
}

TEST_F(HostileCrowd, OfConnectionsThatSayNothingKeepsNobodyOut) {
  std::deque<RawClient> silent;
  for (int i = 0; i < 300; ++i) silent.emplace_back(server_->port(), fs::path());
  expect_room();
}

TEST_F(HostileCrowd, OfRequestsKeepsNobodyOut) {
  const std::string eve = guest(Role::kObserver, "eve");
  for (const std::string& cookie : {eve, std::string()}) {
    RawClient client(server_->port(), authority());
    std::string all;
    for (int i = 0; i < 1200; ++i) {
      client.send(fmt::format("HEAD /index.html HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n",
                              server_->port(), cookie));
    }
    while (all.find("429 Too Many Requests") == std::string::npos && client.read(all)) {
    }
    EXPECT_NE(all.find("429 Too Many Requests"), std::string::npos);
  }
  expect_room();
}

TEST_F(HostileCrowd, OfWrongPasswordsKeepsNobodyElseOut) {
  ASSERT_TRUE(accounts_->add({"ada", Role::kSuperUser, {}}, "correct horse"));
  std::string last;
  for (int i = 0; i < 12 && status_of(last) != "429"; ++i) {
    last = ask("POST", "/login", origin(), "name=eve&password=guess" + std::to_string(i));
  }
  EXPECT_EQ(status_of(last), "429");
  const std::string in = ask("POST", "/login", origin(), "name=ada&password=correct+horse");
  EXPECT_EQ(status_of(in), "303");
  expect_room();
}

}  // namespace
}  // namespace rave::gui_server::testing
