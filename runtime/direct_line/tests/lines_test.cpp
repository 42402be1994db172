// SPDX-License-Identifier: Apache-2.0
// Hosts and GUI Server on a real bus: who has a line, and how fast a withdrawal ends it.
#include "rave/direct_line/lines.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>

#include "page_key.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "rave/web_testing/raw_client.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

using web::testing::RawSocket;
using Clock = std::chrono::steady_clock;

bool comes_true(const std::function<bool()>& what) {
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (!what()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

class LinesOnBus : public ::testing::Test {
 public:
  LinesOnBus() {
    bus_.participant = "test";
    bus_.run = bus::RunId::random();
    bus_.beside = true;
    bus_.tag = bus_.run.text();
    runtime::RunStatus status;
    status.scenario = "test";
    status.robots.emplace_back().name = "r1";
    control_.begin(status);
  }
  ~LinesOnBus() override { control_.end(); }

 protected:
  [[nodiscard]] std::unique_ptr<LineServer> line(const std::string& host) {
    LineOptions options;
    options.run = bus_.run.text();
    options.host = host;
    options.signer = signer_.open;
    auto started = LineServer::start(options, control_);
    EXPECT_TRUE(started) << started.error().text();
    return *std::move(started);
  }
  [[nodiscard]] std::unique_ptr<Lines> gui() {
    auto lines = lines_on_bus(bus_, [](const std::string& host) {
      return host == "left" ? std::vector<std::string>{"r1"} : std::vector<std::string>();
    });
    EXPECT_TRUE(lines) << lines.error().text();
    return *std::move(lines);
  }
  [[nodiscard]] std::unique_ptr<LineBeacon> beacon(const std::string& host, LineServer& server) {
    auto beacon = LineBeacon::start(bus_, host, server, control_, log_);
    EXPECT_TRUE(beacon) << beacon.error().text();
    return *std::move(beacon);
  }
  [[nodiscard]] RawSocket page_at(const LineServer& server, std::uint64_t epoch,
                                  const std::string& user = "anna") const {
    Ticket ticket;
    ticket.run = bus_.run.text();
    ticket.host = "left";
    ticket.user = user;
    ticket.nonce = user;
    ticket.role = "commander";
    ticket.origin = "http://gui";
    ticket.orders.all = true;
    ticket.page_key = page_.point();
    ticket.epoch = epoch;
    ticket.expires_s = std::chrono::duration_cast<std::chrono::seconds>(
                           std::chrono::system_clock::now().time_since_epoch())
                           .count() +
                       60;
    const std::string text = sign_ticket(ticket, signer_);
    RawSocket socket(server.port(), {}, "Origin: http://gui\r\n");
    const std::string first = socket.text_with("\"challenge\"");
    const std::string mark = "\"challenge\":\"";
    const std::size_t at = first.find(mark) + mark.size();
    const std::string challenge = first.substr(at, first.find('"', at) - at);
    const std::string address = "127.0.0.1:" + std::to_string(server.port());
    socket.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" +
                base64_of(page_.sign(proof_text(challenge, address, text))) + "\"}");
    return socket;
  }

  bus::BusConfig bus_;
  SigningKey signer_ = new_signing_key();
  testing::PageKey page_;
  runtime::RunControl control_;
  NullLogSink log_;
};

TEST_F(LinesOnBus, AWithdrawalEndsALineWithinASecond) {
  const auto server = line("left");
  const auto told = beacon("left", *server);
  const auto lines = gui();
  ASSERT_TRUE(comes_true([&] { return lines->hosts().size() == 1; }));
  EXPECT_EQ(lines->hosts()[0], (HostLine{"left", server->url(), {"r1"}}));
  RawSocket anna = page_at(*server, 5);
  ASSERT_NE(anna.text_with("\"welcome\""), "");
  const auto before = Clock::now();
  lines->withdraw("anna", sign_withdrawal({bus_.run.text(), "anna", 6}, signer_));
  EXPECT_EQ(anna.close_code(), 4403);
  EXPECT_LT(Clock::now() - before, std::chrono::seconds(1));
}

TEST_F(LinesOnBus, WithoutAThreadThereIsNoLineAndNothingIsAnnounced) {
  const auto lines = gui();
  LineOptions options;
  options.run = bus_.run.text();
  options.host = "left";
  options.signer = signer_.open;
  const auto server = line("left");
  // The beacon asks for its thread before it opens a bus.
  const base_testing::NoThreads none;
  const auto started = LineServer::start(options, control_);
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("cannot start the thread of the web server"),
            std::string::npos);
  const auto told = LineBeacon::start(bus_, "left", *server, control_, log_);
  ASSERT_FALSE(told);
  EXPECT_NE(told.error().message.find("cannot start the thread of the direct line"),
            std::string::npos);
  EXPECT_TRUE(lines->hosts().empty());
}

TEST_F(LinesOnBus, AHostThatComesLaterKnowsWhatWasWithdrawn) {
  const auto lines = gui();
  lines->withdraw("anna", sign_withdrawal({bus_.run.text(), "anna", 6}, signer_));
  const auto server = line("left");
  const auto told = beacon("left", *server);
  // Until it has heard of it, a line lives; then none is let in.
  ASSERT_TRUE(comes_true([&] { return page_at(*server, 5).close_code() == 4401; }));
  EXPECT_NE(page_at(*server, 6).text_with("\"welcome\""), "");
}

TEST_F(LinesOnBus, ForgesOfTheBusCountForNothing) {
  const auto server = line("left");
  const auto told = beacon("left", *server);
  const auto stranger = line("nowhere");
  const auto strange = beacon("nowhere", *stranger);
  const auto lines = gui();
  ASSERT_TRUE(comes_true([&] { return lines->hosts().size() == 1; }));
  RawSocket anna = page_at(*server, 5);
  ASSERT_NE(anna.text_with("\"welcome\""), "");
  lines->withdraw("anna", sign_withdrawal({bus_.run.text(), "anna", 9}, new_signing_key()));
  // One writer's samples come in order: when the last one counts, those before it have come.
  lines->withdraw("cleo", sign_withdrawal({bus_.run.text(), "cleo", 9}, signer_));
  ASSERT_TRUE(comes_true([&] { return page_at(*server, 5, "cleo").close_code() == 4401; }));
  anna.send(R"({"type":"ping","id":1})");
  // A line of cleo that was quicker than the bus may have been ended; anna's lives.
  EXPECT_NE(anna.text_with("\"pong\""), "");
  // A host that the scenario does not have is not told of.
  EXPECT_EQ(lines->hosts().size(), 1U);
}

TEST_F(LinesOnBus, AHostThatEndsIsTakenBackAndANewOneIsFound) {
  const auto lines = gui();
  auto server = line("left");
  auto told = beacon("left", *server);
  ASSERT_TRUE(comes_true([&] { return lines->hosts().size() == 1; }));
  told.reset();
  ASSERT_TRUE(comes_true([&] { return lines->hosts().empty(); }));
  server = line("left");
  told = beacon("left", *server);
  ASSERT_TRUE(comes_true([&] { return lines->hosts().size() == 1; }));
  EXPECT_EQ(lines->hosts()[0].url, server->url());
}

TEST_F(LinesOnBus, AHostInLockStepHasALineAsAnyOther) {
  runtime::RunStatus follows;
  follows.scenario = "test";
  follows.follows = true;
  control_.end();
  control_.begin(follows);
  const auto server = line("left");
  const auto told = beacon("left", *server);
  const auto lines = gui();
  ASSERT_TRUE(comes_true([&] { return lines->hosts().size() == 1; }));
  RawSocket anna = page_at(*server, 5);
  ASSERT_NE(anna.text_with("\"welcome\""), "");
  anna.send(R"({"type":"order","id":1,"kind":"cancel","robot":"r1"})");
  std::string asked;
  ASSERT_TRUE(comes_true([&] {
    control_.serve(
        [&asked](const request::Request& request) -> Result<std::string> {
          asked = request.robot;
          return std::string("done here");
        },
        [](runtime::RunStatus&) {});
    return !asked.empty();
  }));
  EXPECT_EQ(asked, "r1");
  EXPECT_NE(anna.text_with("\"answer\"").find("done here"), std::string::npos);
}

}  // namespace
}  // namespace rave::direct_line
