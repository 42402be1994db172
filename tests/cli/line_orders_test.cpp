// SPDX-License-Identifier: Apache-2.0
// The direct line of a host in lock-step: it owns the leases of its robots, and refuses a second
// person while the environment manager stands still and can be asked nothing.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "page_key.hpp"
#include "process.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/direct_line_testing/page_of_test.hpp"
#include "rave/web_testing/raw_client.hpp"
#include "signed_text.hpp"

namespace rave::cli_test {
namespace {

using direct_line::Ticket;
using direct_line::testing::PageKey;
using web::testing::RawSocket;
using Words = std::vector<std::string>;
constexpr const char* kHost = "host-2";  // with bert

std::uint16_t any_port() {
  const int file = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  static_cast<void>(::bind(file, reinterpret_cast<sockaddr*>(&address), size));
  static_cast<void>(::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size));
  ::close(file);
  return ntohs(address.sin_port);
}

/// A person at the direct line of the host.
class Person {
 public:
  Person(std::uint16_t port, const std::string& run, const std::string& name,
         const direct_line::SigningKey& key)
      : socket_(port, {}, "Origin: http://gui\r\n") {
    const PageKey page;
    Ticket ticket;
    ticket.run = run;
    ticket.host = kHost;
    ticket.user = ticket.nonce = name;
    ticket.role = "commander";
    ticket.origin = "http://gui";
    ticket.orders.all = ticket.stops.all = true;
    ticket.page_key = page.point();
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    ticket.epoch = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
    ticket.expires_s = std::chrono::duration_cast<std::chrono::seconds>(now).count() + 600;
    const std::string text = direct_line::sign_ticket(ticket, key);
    const std::string first = socket_.text_with("\"challenge\":");
    const std::string mark = "\"challenge\":\"";
    const std::size_t at = first.find(mark);
    if (at == std::string::npos) return;
    const std::size_t begin = at + mark.size();
    const std::string challenge = first.substr(begin, first.find('"', begin) - begin);
    const std::string address = "127.0.0.1:" + std::to_string(port);
    const std::string proof = direct_line::proof_text(challenge, address, text);
    socket_.send(R"({"type":"hello","ticket":")" + text + R"(","proof":")" +
                 direct_line::base64_of(page.sign(proof)) + "\"}");
    welcome = !socket_.text_with("\"welcome\"").empty();
  }
  /// The answer to an order; `more`: other members of it.
  std::string ask(const std::string& kind, const std::string& robot, const std::string& more = {}) {
    const std::string id = "\"id\":" + std::to_string(++asked_);
    socket_.send(R"({"type":"order",)" + id + R"(,"kind":")" + kind + R"(","robot":")" + robot +
                 "\"" + more + "}");
    return socket_.text_with(id + ",");
  }

  bool welcome = false;

 private:
  RawSocket socket_;
  int asked_ = 0;
};

class LineOrders : public ::testing::Test {
 protected:
  void SetUp() override {
    const Ended made = run_rave({"keys", "line", key_file()});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto key = direct_line::read_signing_key(key_file());
    ASSERT_TRUE(key) << key.error().text();
    key_ = *key;
    start("env", {"env", "orders.yaml", "--pace", "realtime"});
    for (const std::string host : {"host-1", "host-2", "host-3"}) {
      Words words = {"robot", "orders.yaml", "--host", host};
      if (host == kHost) {
        for (const std::string& word : {std::string("--web"), "127.0.0.1:" + std::to_string(port_),
                                        std::string("--web-key"), key_file() + ".pub"}) {
          words.push_back(word);
        }
      }
      start(host, words);
    }
  }
  void TearDown() override {
    for (const pid_t process : processes_) {
      ::kill(process, SIGKILL);
      static_cast<void>(wait_for(process));
    }
  }
  void start(const std::string& name, Words words) {
    for (const std::string& word :
         {std::string("--processes"), std::string("3"), std::string("--duration"),
          std::string("100000"), std::string("--no-picture"), std::string("--no-record"),
          std::string("--run"), run_, std::string("--bus-tag"), folder_.path().filename().string(),
          std::string("--output"), (folder_.path() / name).string()}) {
      words.push_back(word);
    }
    processes_.push_back(start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()},
                                    (folder_.path() / (name + ".log")).string()));
    ASSERT_GT(processes_.back(), 0);
  }
  [[nodiscard]] std::string key_file() const { return (folder_.path() / "line_key").string(); }
  [[nodiscard]] std::unique_ptr<Person> person(const std::string& name) const {
    for (int i = 0; i < 600; ++i) {
      auto one = std::make_unique<Person>(port_, run_, name, key_);
      if (one->welcome) return one;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << content_of((folder_.path() / "host-2.log").string());
    return nullptr;
  }

  TemporaryFolder folder_;
  const std::string run_ = bus::RunId::random().text();
  const std::uint16_t port_ = any_port();
  direct_line::SigningKey key_;
  std::vector<pid_t> processes_;  ///< The manager first.
};

TEST_F(LineOrders, TheHostRefusesASecondPersonWithoutItsManager) {
  const auto anna = person("anna");
  const auto mona = person("mona");
  ASSERT_TRUE(anna && mona);
  std::string taken;
  // Until all hosts are there, nobody is in a run.
  for (int i = 0; i < 600 && taken.find("\"good\":true") == std::string::npos; ++i) {
    taken = anna->ask("take", "bert");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_NE(taken.find("bert is yours"), std::string::npos) << taken;
  const std::string drive = R"(,"v":0.1,"w":0,"echo":true)";
  const std::string driven = anna->ask("drive", "bert", drive);
  EXPECT_NE(driven.find("bert is driven; counts from step"), std::string::npos) << driven;

  ASSERT_EQ(::kill(processes_.front(), SIGSTOP), 0);
  for (const std::string kind : {"take", "cancel"}) {
    const std::string refused = mona->ask(kind, "bert");
    EXPECT_NE(refused.find("`anna` drives bert"), std::string::npos) << kind << ": " << refused;
    EXPECT_NE(refused.find("\"good\":false"), std::string::npos) << refused;
  }
  const std::string refused = mona->ask("drive", "bert", drive);
  EXPECT_NE(refused.find("`anna` drives bert"), std::string::npos) << refused;
  const std::string elsewhere = mona->ask("cancel", "carl");
  EXPECT_NE(elsewhere.find("runs in another process"), std::string::npos) << elsewhere;
  ASSERT_EQ(::kill(processes_.front(), SIGCONT), 0);

  EXPECT_NE(anna->ask("give", "bert").find("no person drives bert now"), std::string::npos);
  const std::string goal = mona->ask("goal", "bert", R"(,"points":[[-2.5,-3]])");
  EXPECT_NE(goal.find("bert is sent to -2.50, -3.00; counts from step"), std::string::npos) << goal;
}

}  // namespace
}  // namespace rave::cli_test
