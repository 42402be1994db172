// SPDX-License-Identifier: Apache-2.0
// Who gets a ticket for a direct line, what it names, and how it is withdrawn.
#include <chrono>
#include <mutex>
#include <thread>

#include "hostile_fixture.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::gui_server::testing {
namespace {

/// One host with all robots, which remembers what was withdrawn.
class FakeLines final : public direct_line::Lines {
 public:
  [[nodiscard]] std::string run() const override { return "0123"; }
  [[nodiscard]] std::vector<direct_line::HostLine> hosts() const override {
    return {{"left", "wss://left.example:8090/ws", {"walker-1", "spy-2", "walker-3", "spy-4"}}};
  }
  void withdraw(const std::string& user, const std::string& text) override {
    const std::lock_guard lock(mutex_);
    told_.emplace_back(user, text);
  }
  /// Waits for the first withdrawal.
  [[nodiscard]] std::pair<std::string, std::string> told() const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < end) {
      {
        const std::lock_guard lock(mutex_);
        if (!told_.empty()) return told_.front();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return {};
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<std::string, std::string>> told_;
};

std::string ticket_in(const std::string& answer) {
  const std::string mark = "\"ticket\":\"";
  const std::size_t at = answer.find(mark);
  if (at == std::string::npos) return {};
  return answer.substr(at + mark.size(), answer.find('"', at + mark.size()) - at - mark.size());
}

std::int64_t today_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

constexpr const char* kPageKey =
    R"({"key":"BAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"})";

TEST_F(Hostile, TicketsNameWhatTheirOwnerMayAndAreWithdrawn) {
  const auto key = direct_line::new_signing_key();
  const auto lines = std::make_shared<FakeLines>();
  server_->offer_lines(lines, key);
  const std::string ben = guest(Role::kCommander, "ben");
  const std::string answer = ask("POST", "/ticket", ben + origin(), kPageKey);
  EXPECT_EQ(status_of(answer), "200") << answer;
  const auto ticket = direct_line::verify_ticket(ticket_in(answer), key.open, today_s());
  ASSERT_TRUE(ticket) << ticket.error().text();
  EXPECT_EQ(ticket->user, "ben");
  EXPECT_EQ(ticket->role, "commander");
  EXPECT_EQ(ticket->host, "left");
  EXPECT_EQ("Origin: " + ticket->origin + "\r\n", origin());
  EXPECT_EQ(ticket->orders.names, (std::set<std::string, std::less<>>{"walker-1", "walker-3"}));
  EXPECT_TRUE(ticket->stops.all);
  EXPECT_FALSE(ticket->orders.has("spy-2"));
  // The page may reach the hosts of its run and nobody else.
  EXPECT_NE(ask("GET", "/", ben).find("connect-src 'self' wss://left.example:8090;"),
            std::string::npos);
  RawSocket boss = super_user();
  set_right(boss, "commander", "stop", "\"own\"");
  const auto [user, text] = lines->told();
  EXPECT_EQ(user, "ben");
  const auto withdrawal = direct_line::verify_withdrawal(text, key.open);
  ASSERT_TRUE(withdrawal) << withdrawal.error().text();
  EXPECT_EQ(withdrawal->user, "ben");
  EXPECT_GT(withdrawal->epoch, ticket->epoch);
  const auto next = direct_line::verify_ticket(
      ticket_in(ask("POST", "/ticket", ben + origin(), kPageKey)), key.open, today_s());
  ASSERT_TRUE(next) << next.error().text();
  EXPECT_EQ(next->epoch, withdrawal->epoch);
  EXPECT_FALSE(next->stops.all);
  EXPECT_TRUE(audited(R"("what":"withdrawn","user":"ben")"));
}

TEST_F(Hostile, WhoIsRemovedLosesTheirTickets) {
  const auto lines = std::make_shared<FakeLines>();
  server_->offer_lines(lines, direct_line::new_signing_key());
  const std::string ben = guest(Role::kCommander, "ben");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben + origin(), kPageKey)), "200");
  ASSERT_TRUE(accounts_->remove("ben"));
  EXPECT_EQ(lines->told().first, "ben");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben + origin(), kPageKey)), "401");
}

TEST_F(Hostile, TicketsAreForCommandersWithAKey) {
  server_->offer_lines(std::make_shared<FakeLines>(), direct_line::new_signing_key());
  const std::string eve = guest(Role::kObserver, "eve");
  const std::string refused = ask("POST", "/ticket", eve + origin(), kPageKey);
  EXPECT_EQ(status_of(refused), "403");
  EXPECT_EQ(refused.find("ticket\":"), std::string::npos);
  EXPECT_EQ(refused.find("left.example"), refused.find("connect-src 'self' wss://left.example"));
  EXPECT_TRUE(audited(R"("why":"ticket","user":"eve")"));
  const std::string ben = guest(Role::kCommander, "ben");
  EXPECT_EQ(status_of(ask("POST", "/ticket", origin(), kPageKey)), "401");
  EXPECT_EQ(status_of(ask("GET", "/ticket", ben + origin())), "405");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben, kPageKey)), "400");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben + "Origin: https://evil.example\r\n", kPageKey)),
            "403");
  const std::pair<const char*, const char*> bodies[] = {
      {"", "not a valid request"},
      {"{}", "`key` is missing"},
      {R"({"key":"AAAA"})", "point of P-256"},
      {R"({"key":3})", "`key`: expected a string"},
      {R"({"key":"AAAA","user":"ada"})", "unknown members"},
      {"[]", "not a valid request"},
      {"\xff", "not a valid request"}};
  for (const auto& [body, why] : bodies) {
    const std::string answer = ask("POST", "/ticket", ben + origin(), body);
    EXPECT_EQ(status_of(answer), "400") << body;
    EXPECT_NE(answer.find(why), std::string::npos) << answer;
  }
}

}  // namespace
}  // namespace rave::gui_server::testing
