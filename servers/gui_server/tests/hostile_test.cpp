// SPDX-License-Identifier: Apache-2.0
// A client that has an observer's session, or none, and tries everything: over real sockets and
// real TLS, against a whole server. What it may not know is searched for in every byte that it
// gets.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <thread>

#include "fake_run.hpp"
#include "rave/base/file.hpp"
#include "rave/direct_line/lines.hpp"
#include "rave/gui_server/accounts.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "rave/keys/web_keys.hpp"
#include "raw_client.hpp"

namespace rave::gui_server::testing {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(auto value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

/// What nobody of team green may be told, as it would be encoded.
std::vector<std::string> secrets() {
  return {"spy-", "secret-pond", bytes_of(FakeRun::kSecretRange_m), bytes_of(FakeRun::kHalfRange_m),
          // As frames.cpp has it, whose quantum is a float.
          bytes_of(static_cast<std::int32_t>(std::lround(FakeRun::kSecretX_m / double{1e-4F})))};
}

class Hostile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "rave-hostile-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directory(folder_ / "page");
    std::ofstream(folder_ / "page/index.html") << "<!doctype html><title>page</title>\n";
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    ASSERT_TRUE(
        keys::make_web_keys({folder_ / "web",
                             {"127.0.0.1"},
                             10,
                             std::chrono::duration_cast<std::chrono::seconds>(now).count()}));
    auto accounts = Accounts::open(folder_ / "accounts");
    ASSERT_TRUE(accounts) << accounts.error().text();
    accounts_ = *std::move(accounts);
    options_.page = folder_ / "page";
    options_.port = 0;
    options_.certificate = folder_ / "web/server.pem";
    options_.key = folder_ / "web/server_key.pem";
    options_.accounts = folder_ / "accounts";
    start();
  }
  void TearDown() override {
    server_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  void start() {
    auto started = GuiServer::start(options_, run_);
    ASSERT_TRUE(started) << started.error().text();
    server_ = *std::move(started);
    // Observers see their own team, and no virtual obstacles.
    RawSocket boss = super_user();
    set_right(boss, "observer", "pose", "\"own\"");
    set_right(boss, "observer", "obstacles", "\"none\"");
  }
  static void set_right(RawSocket& boss, const char* role, const char* what, const char* reach) {
    boss.send(fmt::format(R"({{"type":"set_right","role":"{}","class":"{}","reach":{}}})", role,
                          what, reach));
    EXPECT_NE(boss.text_with("\"to\":\"set_right\"").find("\"good\":true"), std::string::npos);
  }

  [[nodiscard]] fs::path authority() const { return folder_ / "web/authority.pem"; }
  /// The whole answer to one request.
  [[nodiscard]] std::string ask(const std::string& method, const std::string& target,
                                const std::string& headers = {}, const std::string& body = {}) {
    RawClient client(server_->port(), authority());
    EXPECT_TRUE(client.good());
    client.send(
        fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nConnection: close\r\nContent-Length: "
                    "{}\r\n{}\r\n{}",
                    method, target, server_->port(), body.size(), headers, body));
    return client.read_all();
  }
  [[nodiscard]] static std::string status_of(const std::string& answer) {
    return answer.size() < 12 ? answer : answer.substr(9, 3);
  }
  /// The header with the cookie of an answer; empty: it has none.
  [[nodiscard]] static std::string cookie_of(const std::string& answer) {
    const std::size_t at = answer.find("Set-Cookie: ");
    if (at == std::string::npos) return {};
    const std::string value = answer.substr(at + 12, answer.find(';', at) - at - 12);
    return "Cookie: " + value + "\r\n";
  }
  [[nodiscard]] std::string origin() const {
    return fmt::format("Origin: https://127.0.0.1:{}\r\n", server_->port());
  }
  [[nodiscard]] RawSocket socket(const std::string& cookie) const {
    return {server_->port(), authority(), cookie + origin()};
  }
  [[nodiscard]] RawSocket super_user() {
    const std::string link = server_->entry();
    return socket(cookie_of(ask("GET", link.substr(link.find("/enter")))));
  }
  /// Joins by an invitation; returns the cookie.
  [[nodiscard]] std::string guest(Role role, const std::string& name) {
    const auto secret = accounts_->invite(role, {false, {"green"}}, 1, 7, "test");
    EXPECT_TRUE(secret);
    EXPECT_EQ(status_of(ask("GET", "/join?invite=" + *secret)), "200");
    std::string cookie =
        cookie_of(ask("POST", "/join", origin(), "invite=" + *secret + "&name=" + name));
    EXPECT_NE(cookie, "");
    return cookie;
  }
  [[nodiscard]] std::string audit() const {
    return read_file(folder_ / "accounts/audit.jsonl").value_or("");
  }

  fs::path folder_;
  GuiOptions options_;
  std::shared_ptr<FakeRun> run_ = std::make_shared<FakeRun>();
  std::unique_ptr<Accounts> accounts_;  ///< As the command line has them.
  std::unique_ptr<GuiServer> server_;
};

constexpr const char* kLookAtAll =
    R"({"type":"look","poses":true,"true_poses":true,"parts":true,"max_hz":60,)"
    R"("readings":[[0,0],[1,0],[2,0],[3,0],[4294967295,0]]})";

/// Looks at everything until so many readings came; acknowledges frames as a page does.
void look_until(RawSocket& socket, int readings) {
  socket.send(kLookAtAll);
  int frames = 2;
  while (readings > 0 || frames > 0) {
    const auto frame = socket.next();
    ASSERT_TRUE(frame) << "the connection ended";
    if (frame->opcode != 2 || frame->payload.empty()) continue;
    if (frame->payload[0] == 2) --readings;
    if (frame->payload[0] != 1 || frame->payload.size() < 8) continue;
    --frames;
    std::uint32_t sequence = 0;
    std::memcpy(&sequence, frame->payload.data() + 4, sizeof sequence);
    socket.send(fmt::format(R"({{"type":"ack","sequence":{}}})", sequence));
  }
}

TEST_F(Hostile, ASuperUserGetsWhatIsSearchedForBelow) {
  RawSocket boss = super_user();
  look_until(boss, 8);
  for (const std::string& secret : secrets()) {
    EXPECT_NE(boss.heard().find(secret), std::string::npos) << secret;
  }
}

TEST_F(Hostile, AnObserverGetsNothingThatIsWithheldWhateverTheyAsk) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  ASSERT_TRUE(eve.answer().starts_with("HTTP/1.1 101")) << eve.answer();
  for (const char* const request :
       {R"({"type":"transport","do":"pause"})", R"({"type":"transport","do":"seek","value":0})",
        R"({"type":"transport","do":"step","value":5})",
        R"({"type":"halt","do":"stop","slots":[]})", R"({"type":"halt","do":"stop","slots":[0]})",
        R"({"type":"halt","do":"release","slots":[1]})",
        R"({"type":"halt","do":"stop","slots":[2,3]})",
        R"({"type":"set_right","role":"observer","class":"pose","reach":"all"})",
        R"({"type":"set_right","user":"eve","class":"recording","reach":"all"})",
        R"({"type":"see_as","role":"super_user"})", R"({"type":"see_as","user":"ada"})"}) {
    eve.send(request);
    EXPECT_NE(eve.text_with("\"type\":\"answer\"").find("\"good\":false"), std::string::npos)
        << request;
  }
  look_until(eve, 4);
  const std::string& heard = eve.heard();
  for (const std::string& secret : secrets()) {
    EXPECT_EQ(heard.find(secret), std::string::npos) << secret;
  }
  // What they may see is there.
  EXPECT_NE(heard.find("walker-3"), std::string::npos);
  EXPECT_NE(heard.find("walker-1: at home"), std::string::npos);
  EXPECT_NE(heard.find("hall"), std::string::npos);
  EXPECT_NE(heard.find(bytes_of(FakeRun::kOpenRange_m)), std::string::npos);
  EXPECT_NE(heard.find(R"("hidden":["virtual"])"), std::string::npos);
  EXPECT_EQ(heard.find("nowhere"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 0);
  EXPECT_EQ(run_->moved, 0);
}

TEST_F(Hostile, RightsThatChangeAreInForceOnOpenConnections) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  EXPECT_NE(eve.text_with("\"roster\"").find("walker-1"), std::string::npos);
  RawSocket boss = super_user();
  set_right(boss, "observer", "pose", "[\"blue\"]");
  const std::string other = eve.text_with("\"roster\"");
  EXPECT_EQ(other.find("walker"), std::string::npos);
  EXPECT_NE(other.find("spy-2"), std::string::npos);
  // Their teams did not change, so of these robots they get no readings, and no sensors to ask for.
  EXPECT_EQ(other.find("scan"), std::string::npos);
  // And they outlive the server.
  server_.reset();
  auto again = GuiServer::start(options_, run_);
  ASSERT_TRUE(again) << again.error().text();
  server_ = *std::move(again);
  EXPECT_NE(audit().find("pose of observer: blue"), std::string::npos);
}

TEST_F(Hostile, SeeAsShowsExactlyWhatSomebodyGets) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  const std::string hers = eve.text_with("\"roster\"");
  RawSocket boss = super_user();
  EXPECT_NE(boss.text_with("\"roster\""), hers);
  boss.send(R"({"type":"see_as","user":"eve"})");
  const std::string hello = boss.text_with("\"hello\"");
  EXPECT_NE(hello.find(R"("user":{"name":"eve","role":"observer"})"), std::string::npos) << hello;
  EXPECT_NE(hello.find(R"("seen_by":{"name":"you","role":"super_user"})"), std::string::npos);
  EXPECT_EQ(boss.text_with("\"roster\""), hers);
  // With her eyes nothing can be changed; with their own again it can.
  boss.send(R"({"type":"set_right","role":"observer","class":"pose","reach":"all"})");
  EXPECT_NE(boss.text_with("\"to\":\"set_right\"").find("\"good\":false"), std::string::npos);
  boss.send(R"({"type":"see_as"})");
  EXPECT_NE(boss.text_with("\"roster\"").find("spy-2"), std::string::npos);
  set_right(boss, "observer", "pose", "\"all\"");
}

TEST_F(Hostile, ACommanderStopsOnlyWhatTheyMay) {
  RawSocket boss = super_user();
  set_right(boss, "commander", "stop", "\"own\"");
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  ben.send(R"({"type":"halt","do":"stop","slots":[1]})");
  EXPECT_NE(ben.text_with("\"to\":\"stop\"").find("\"good\":false"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 0);
  ben.send(R"({"type":"halt","do":"stop","slots":[]})");
  EXPECT_NE(ben.text_with("\"to\":\"stop\"").find("\"good\":true"), std::string::npos);
  EXPECT_EQ(run_->halted_robots, 2);
  EXPECT_NE(audit().find(R"("what":"stop","user":"ben")"), std::string::npos) << audit();
}

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
  EXPECT_NE(audit().find(R"("what":"withdrawn","user":"ben")"), std::string::npos);
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
  EXPECT_NE(audit().find(R"("why":"ticket","user":"eve")"), std::string::npos);
  const std::string ben = guest(Role::kCommander, "ben");
  EXPECT_EQ(status_of(ask("POST", "/ticket", origin(), kPageKey)), "401");
  EXPECT_EQ(status_of(ask("GET", "/ticket", ben + origin())), "405");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben, kPageKey)), "400");
  EXPECT_EQ(status_of(ask("POST", "/ticket", ben + "Origin: https://evil.example\r\n", kPageKey)),
            "403");
  for (const char* const body : {"", "{}", R"({"key":"AAAA"})", R"({"key":3})",
                                 R"({"key":"AAAA","user":"ada"})", "[]", "\xff"}) {
    const std::string answer = ask("POST", "/ticket", ben + origin(), body);
    EXPECT_EQ(status_of(answer), "400") << body;
    EXPECT_NE(answer.find("with a public key of P-256"), std::string::npos) << answer;
  }
}

TEST_F(Hostile, OrdersOfAnObserverAreRefusedAndLogged) {
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  for (const char* const request :
       {R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1,"w":0})",
        R"({"type":"order","request":2,"kind":"goal","slots":[0,1],"points":[[0,0]]})",
        R"({"type":"order","request":3,"kind":"cancel","slots":[0]})",
        R"({"type":"order","request":4,"kind":"text","slots":[0],"text":"run"})",
        R"({"type":"order","request":5,"kind":"place","slots":[0],"points":[[0,0]]})",
        R"({"type":"lease","request":6,"do":"force","slots":[0]})",
        R"({"type":"set","request":7,"slots":[0],"key":"program.v","value":9})",
        R"({"type":"edit","request":8,"do":"remove","name":"secret-pond"})",
        R"({"type":"edit","request":9,"do":"add","name":"a","pose":[0,0,0],"disc":1})",
        R"({"type":"order","request":10,"kind":"cancel","slots":[3]})",
        R"({"type":"order","request":11,"kind":"cancel","slots":[4294967295]})"}) {
    eve.send(request);
    const std::string answer = eve.text_with("\"type\":\"answer\"");
    EXPECT_NE(answer.find("\"good\":false"), std::string::npos) << request;
    EXPECT_NE(answer.find("Your rights do not include this."), std::string::npos) << answer;
  }
  EXPECT_TRUE(run_->commands().empty());
  EXPECT_NE(audit().find(R"("what":"refused","why":"order","user":"eve")"), std::string::npos)
      << audit();
  // Who drives is shown with the robot; whoever is not seen, and what they are called, is not.
  EXPECT_EQ(eve.heard().find("spy"), std::string::npos);
}

TEST_F(Hostile, ACommanderCommandsTheirOwnTeamAlone) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  // Slots are those of the run here, since commanders see all; 1 and 3 are of the other team.
  ben.send(
      R"({"type":"order","request":1,"kind":"goal","slots":[0,1,3],"points":[[1,2],[3,4],[5,6]]})");
  const std::string answer = ben.text_with("\"to\":\"goal\"");
  EXPECT_NE(answer.find(R"("refused":[{"slot":1,)"), std::string::npos) << answer;
  auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].first.slots, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(asked[0].first.points[0], (Vec2{1, 2}));
  EXPECT_EQ(asked[0].second, (Author{"ben", false}));
  for (const char* const request :
       {R"({"type":"order","request":2,"kind":"place","slots":[0],"points":[[0,0]]})",
        R"({"type":"edit","request":3,"do":"add","name":"a","pose":[0,0,0],"disc":1})",
        R"({"type":"lease","request":4,"do":"take","slots":[1]})"}) {
    ben.send(request);
    EXPECT_NE(ben.text_with("\"type\":\"answer\"").find("Your rights"), std::string::npos);
  }
  EXPECT_EQ(run_->commands().size(), 1U);
  EXPECT_NE(audit().find("goal, 3 robots: Your rights do not include this."), std::string::npos);
  RawSocket boss = super_user();
  boss.send(R"({"type":"edit","request":1,"do":"add","name":"a","pose":[0,0,0],"disc":1})");
  EXPECT_NE(boss.text_with("\"to\":\"add\"").find("\"good\":true"), std::string::npos);
  EXPECT_TRUE(run_->commands().back().second.overrides);
}

TEST_F(Hostile, MalformedOrdersNeverReachARun) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  std::string path = R"({"type":"order","request":1,"kind":"path","slots":[0],"points":[)";
  for (int i = 0; i < 10'000; ++i) path += i == 0 ? "[0,1]" : ",[0,1]";
  for (const std::string& request :
       {std::string(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":NaN,"w":0})"),
        std::string(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1e999,"w":0})"),
        std::string(
            R"({"type":"order","request":1,"kind":"goal","slots":[0],"points":[[null,0]]})"),
        std::string(R"({"type":"order","request":-1,"kind":"cancel","slots":[0]})"),
        std::string(
            R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":1,"w":0,"by":"ada"})"),
        path + "]}"}) {
    ben.send(request);
    EXPECT_NE(ben.text_with("\"to\":\"message\"").find("\"good\":false"), std::string::npos)
        << request.substr(0, 80);
  }
  EXPECT_TRUE(run_->commands().empty());
}

TEST_F(Hostile, AFloodOfOrdersIsRefusedAndThenCutOff) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  for (int i = 0; i < 2000; ++i) {
    ben.send(R"({"type":"order","request":1,"kind":"goal","slots":[0,2],"points":[[0,0]]})");
  }
  EXPECT_EQ(ben.close_code(), 4429);
}

TEST_F(Hostile, APageThatGoesLeavesNoRobotDriving) {
  {
    RawSocket ben = socket(guest(Role::kCommander, "ben"));
    ben.send(R"({"type":"order","request":1,"kind":"drive","slots":[0],"v":0.5,"w":0})");
    EXPECT_NE(ben.text_with("\"to\":\"drive\"").find("\"good\":true"), std::string::npos);
  }
  for (int i = 0; i < 1000 && run_->commands().size() < 2; ++i) ::usleep(10'000);
  ASSERT_EQ(run_->commands().size(), 2U);
  EXPECT_TRUE(run_->commands()[1].first.stands());
}

TEST_F(Hostile, WhatIsSaidReachesWhoMayHearItAlone) {
  RawSocket ben = socket(guest(Role::kCommander, "ben"));
  RawSocket eve = socket(guest(Role::kObserver, "eve"));
  RawSocket ada = socket(guest(Role::kCommander, "ada"));
  ben.send(R"({"type":"chat","request":1,"to":"all","text":"good morning"})");
  EXPECT_NE(eve.text_with("good morning").find(R"("name":"ben","role":"commander")"),
            std::string::npos);
  ben.send(R"({"type":"chat","request":2,"to":"user","name":"ada","text":"for ada alone"})");
  ben.send(R"({"type":"chat","request":3,"to":"role","name":"commander","text":"for commanders"})");
  ben.send(R"({"type":"chat","request":4,"to":"robot","slot":0,"text":"to walker-1"})");
  EXPECT_NE(ada.text_with("for commanders"), "");
  EXPECT_NE(ada.heard().find("for ada alone"), std::string::npos);
  EXPECT_NE(eve.text_with("to walker-1"), "");
  EXPECT_EQ(eve.heard().find("for "), std::string::npos);
  // The robot was told, in the name of who said it.
  const auto asked = run_->commands();
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].first.value, "to walker-1");
  EXPECT_EQ(asked[0].second.name, "ben");
  // Who does not command it speaks to people alone; who is not there is told so.
  eve.send(R"({"type":"chat","request":1,"to":"robot","slot":0,"text":"and me"})");
  EXPECT_NE(ben.text_with("and me"), "");
  EXPECT_EQ(run_->commands().size(), 1U);
  eve.send(R"({"type":"chat","request":2,"to":"user","name":"nobody","text":"psst"})");
  EXPECT_NE(eve.text_with("\"request\":2").find("is not here"), std::string::npos);
}

TEST_F(Hostile, ComponentsAreServedToTheirRolesAlone) {
  const std::string eve = guest(Role::kObserver, "eve");
  const std::string ben = guest(Role::kCommander, "ben");
  std::ofstream(folder_ / "heat map.js") << "export const component = 1;\n";
  auto run = std::make_shared<FakeRun>();
  run->about_.components.push_back({"heat_map", folder_ / "heat map.js", {Role::kCommander}});
  server_->show(run);
  RawSocket commander = socket(ben);
  EXPECT_NE(commander.text_with("\"hello\"").find("components/0/heat_map.js"), std::string::npos);
  RawSocket observer = socket(eve);
  EXPECT_EQ(observer.text_with("\"hello\"").find("heat_map"), std::string::npos);
  const std::string path = "/components/0/heat_map.js";
  const std::string served = ask("GET", path, ben);
  EXPECT_EQ(status_of(served), "200");
  EXPECT_NE(served.find("text/javascript"), std::string::npos);
  EXPECT_NE(served.find("export const component"), std::string::npos);
  EXPECT_EQ(status_of(ask("GET", path, eve)), "404");
  EXPECT_EQ(status_of(ask("GET", path)), "401");
  EXPECT_EQ(status_of(ask("GET", "/components/1/heat_map.js", ben)), "404");
  EXPECT_EQ(status_of(ask("GET", "/components/0/../accounts/accounts", ben)), "400");
}

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
  const std::string log = audit();
  EXPECT_NE(log.find(R"("why":"password","user":"ada","from":"127.0.0.1")"), std::string::npos);
  EXPECT_NE(log.find("too many tries"), std::string::npos);
  EXPECT_EQ(log.find("guess"), std::string::npos);
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
