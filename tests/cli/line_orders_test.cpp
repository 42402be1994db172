// SPDX-License-Identifier: Apache-2.0
// The direct line of a host in lock-step: it owns the leases of its robots, and refuses a second
// person while the environment manager stands still and can be asked nothing.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "free_port.hpp"
#include "line_hello.hpp"
#include "process.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::cli_test {
namespace {

using web::testing::RawSocket;
using Words = std::vector<std::string>;
constexpr const char* kHost = "host-2";  // with bert

/// A person at the direct line of the host.
class Person {
 public:
  explicit Person(const LineGuest& guest)
      : socket_(guest.port, {}, "Origin: http://gui\r\n"), welcome_(say_hello(socket_, guest)) {}

  [[nodiscard]] bool welcome() const { return welcome_; }
  /// The answer to an order; `more`: other members of it.
  std::string ask(const std::string& kind, const std::string& robot, const std::string& more = {}) {
    const std::string id = "\"id\":" + std::to_string(++asked_);
    socket_.send(R"({"type":"order",)" + id + R"(,"kind":")" + kind + R"(","robot":")" + robot +
                 "\"" + more + "}");
    return socket_.text_with(id + ",");
  }

 private:
  RawSocket socket_;
  bool welcome_ = false;
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
      auto one = std::make_unique<Person>(LineGuest{port_, run_, kHost, name, key_});
      if (one->welcome()) return one;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << content_of((folder_.path() / "host-2.log").string());
    return nullptr;
  }

  TemporaryFolder folder_;
  const std::string run_ = bus::RunId::random().text();
  const std::uint16_t port_ = free_port();
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
