// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include "fake_run.hpp"
#include "rave/base/file.hpp"
#include "rave/gui_server/accounts.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "rave/keys/web_keys.hpp"
#include "rave/web_testing/raw_client.hpp"

namespace rave::gui_server::testing {

using web::testing::RawClient;
using web::testing::RawSocket;

namespace fs = std::filesystem;

/// A whole server with TLS and accounts, and clients who try everything on it. Team green is
/// theirs; what observers may not see is another team and virtual obstacles.
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
  /// Waits until so many commands have reached the run, ten seconds at most, and returns all.
  [[nodiscard]] auto commands(std::size_t count) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (run_->commands().size() < count && std::chrono::steady_clock::now() < end) {
      ::usleep(1000);
    }
    return run_->commands();
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
  /// Joins by an invitation; returns the cookie. `given`: it is for that name.
  [[nodiscard]] std::string guest(Role role, const std::string& name, bool given = false) {
    const auto secret =
        accounts_->invite(role, {false, {"green"}}, 1, 7, "test", given ? name : "");
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
  /// Whether the audit log has this text, or gets it within five seconds: an answer can be read
  /// before the server has written the line about it.
  [[nodiscard]] bool audited(std::string_view text) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (audit().find(text) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }

  fs::path folder_;
  GuiOptions options_;
  std::shared_ptr<FakeRun> run_ = std::make_shared<FakeRun>();
  std::unique_ptr<Accounts> accounts_;  ///< As the command line has them.
  std::unique_ptr<GuiServer> server_;
};

}  // namespace rave::gui_server::testing
