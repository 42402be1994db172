// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "page_key.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "rave/keys/web_keys.hpp"
#include "rave/web_testing/raw_client.hpp"
#include "signed_text.hpp"

namespace rave::direct_line::testing {

namespace fs = std::filesystem;
using web::testing::RawSocket;

inline constexpr const char* kOrigin = "https://gui.example:8080";

/// A run that does at once what it is asked, and knows what that was.
class FakeRun {
 public:
  FakeRun() : thread_([this](const std::stop_token& stop) { work(stop); }) {
    runtime::RunStatus status;
    status.scenario = "fake";
    for (const char* const name : {"green-1", "green-2", "blue-1"}) {
      status.robots.emplace_back().name = name;
    }
    control_.begin(status);
  }
  ~FakeRun() {
    thread_.request_stop();
    thread_.join();
    control_.end();
  }
  [[nodiscard]] runtime::RunControl& control() { return control_; }
  [[nodiscard]] std::vector<request::Request> asked() const {
    const std::lock_guard lock(mutex_);
    return asked_;
  }
  /// Waits until so many were asked.
  [[nodiscard]] std::vector<request::Request> wait_for(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (asked().size() < count && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return asked();
  }
  std::atomic<bool> stuck = false;

 private:
  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      if (!stuck) {
        control_.serve(
            [this](const request::Request& request) -> Result<std::string> {
              const std::lock_guard lock(mutex_);
              asked_.push_back(request);
              if (request.action == request::Action(request::Text{"refuse"})) {
                return fail(ErrorCode::kState, "`ben` drives it");
              }
              return fmt::format("did {} {}", request::name_of(request.action), request.robot);
            },
            [](runtime::RunStatus& status) { status.robots[0].lease = "anna"; });
      }
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  runtime::RunControl control_;
  mutable std::mutex mutex_;
  std::vector<request::Request> asked_;
  std::jthread thread_;
};

/// The log, as text.
class Journal final : public LogSink {
 public:
  void write(LogLevel, std::string_view, std::string_view message) override {
    const std::lock_guard lock(mutex_);
    text_.append(message) += '\n';
  }
  [[nodiscard]] bool has(std::string_view what) const {
    const std::lock_guard lock(mutex_);
    return text_.find(what) != std::string::npos;
  }
  [[nodiscard]] std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

/// A line to a run of this process, and a page with a key.
class DirectLine : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = fs::temp_directory_path() / "rave-line-XXXXXX";
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    ASSERT_TRUE(keys::make_web_keys({folder_ / "web", {"127.0.0.1"}, 10, day_s()}));
    options_.certificate = folder_ / "web/server.pem";
    options_.key = folder_ / "web/server_key.pem";
    options_.run = "0123";
    options_.host = "left";
    options_.signer = signer_.open;
    options_.log = &journal_;
    options_.clock_ms = [this] { return now_ms_.load(); };
    auto started = LineServer::start(options_, run_.control());
    ASSERT_TRUE(started) << started.error().text();
    server_ = *std::move(started);
  }
  void TearDown() override {
    server_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  static std::int64_t day_s() {
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
  }
  [[nodiscard]] Ticket ticket() const {
    Ticket ticket;
    ticket.run = "0123";
    ticket.host = "left";
    ticket.user = "anna";
    ticket.role = "commander";
    ticket.origin = kOrigin;
    ticket.orders.names = {"green-1", "green-2"};
    ticket.stops.all = true;
    ticket.releases.names = {"green-1", "green-2"};
    ticket.page_key = page_.point();
    ticket.epoch = 5;
    ticket.expires_s = now_ms_ / 1000 + kTicketLife_s;
    ticket.nonce = "first";
    return ticket;
  }
  [[nodiscard]] RawSocket dial(const std::string& origin = kOrigin) const {
    return {server_->port(), folder_ / "web/authority.pem", "Origin: " + origin + "\r\n"};
  }
  [[nodiscard]] std::string address() const {
    return "127.0.0.1:" + std::to_string(server_->port());
  }
  static std::string challenge_of(RawSocket& socket) {
    const std::string text = socket.text_with("\"challenge\"");
    const std::string mark = "\"challenge\":\"";
    const std::size_t at = text.find(mark) + mark.size();
    return text.substr(at, text.find('"', at) - at);
  }
  void hello(RawSocket& socket, const std::string& text, const PageKey& key) const {
    const std::string proof = key.sign(proof_text(challenge_of(socket), address(), text));
    socket.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" + base64_of(proof) +
                "\"}");
  }
  [[nodiscard]] std::string signed_ticket() const { return sign_ticket(ticket(), signer_); }
  /// A line that is welcome.
  [[nodiscard]] RawSocket line() const { return line(ticket()); }
  [[nodiscard]] RawSocket line(const Ticket& with) const {
    RawSocket socket = dial(with.origin);
    hello(socket, sign_ticket(with, signer_), page_);
    EXPECT_NE(socket.text_with("\"welcome\""), "");
    return socket;
  }
  /// What comes of a hello that must not be welcome.
  void expect_refused(const std::string& text, const PageKey& key, const char* why,
                      const std::string& origin = kOrigin) {
    RawSocket socket = dial(origin);
    hello(socket, text, key);
    EXPECT_EQ(socket.close_code(), 4401) << why;
    EXPECT_EQ(socket.heard().find("welcome"), std::string::npos);
    EXPECT_TRUE(journal_.has(why)) << why << "\n" << journal_.text();
  }
  static std::string drive(int id, const char* robot, const char* rest = R"("v":0.5,"w":0)") {
    return fmt::format(R"({{"type":"order","id":{},"kind":"drive","robot":"{}",{}}})", id, robot,
                       rest);
  }

  fs::path folder_;
  std::atomic<std::int64_t> now_ms_ = 1'790'000'000'000;
  SigningKey signer_ = new_signing_key();
  PageKey page_;
  Journal journal_;
  FakeRun run_;
  LineOptions options_;
  std::unique_ptr<LineServer> server_;
};

}  // namespace rave::direct_line::testing
