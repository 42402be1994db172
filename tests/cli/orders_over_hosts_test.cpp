// SPDX-License-Identifier: Apache-2.0
// The same orders at the same steps, to robots in one process and in several.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "process.hpp"

namespace rave::cli_test {
namespace {

using Words = std::vector<std::string>;

class OrdersOverHosts : public ::testing::Test {
 protected:
  void TearDown() override {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    static_cast<void>(wait_for(process_));
  }
  [[nodiscard]] Ended rave(const Words& words) const {
    return run_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
  }
  void start(const std::string& name, const Words& more) {
    output_ = folder_.path() / name;
    Words words = {"run",  "orders.yaml", "--output", output_,       "--pace",
                   "0.5x", "--duration",  "9",        "--no-picture"};
    words.insert(words.end(), more.begin(), more.end());
    process_ = start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()}, output_ + ".log");
    ASSERT_GT(process_, 0);
    // Until all hosts have joined.
    wait_until([&] { return rave({"edit", "list"}).exit_code == 0; });
  }
  /// Gives up only when something is broken.
  template <class Holds>
  void wait_until(Holds&& holds) {
    for (int i = 0; i < 3000; ++i) {
      if (holds()) return;
      ASSERT_EQ(::waitpid(process_, nullptr, WNOHANG), 0)
          << "the run has ended: " << content_of(output_ + ".log");
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    FAIL() << "never: " << rave({"ps"}).out;
  }
  /// The time that `rave ps` says of the run, in steps.
  [[nodiscard]] long step() const {
    const std::string out = rave({"ps"}).out;
    const std::size_t end = out.find(" of 9 s");
    if (end == std::string::npos) return -1;
    const std::size_t begin = out.rfind(' ', end - 1);
    return std::lround(100 * std::stod(out.substr(begin, end - begin)));
  }
  /// Holds the run when it has come to this step.
  void go_to(long target) {
    ASSERT_EQ(rave({"pause"}).exit_code, 0);
    long now = -1;
    wait_until([&] {
      const long before = std::exchange(now, step());
      return now >= 0 && now == before;
    });
    ASSERT_LT(now, target) << "it was too fast";
    ASSERT_EQ(rave({"step", "--count", std::to_string(target - now)}).exit_code, 0);
    wait_until([&] { return step() == target; });
  }
  void give(const Words& words) {
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
  /// The hash of a run in which people ask all kinds of things.
  std::string hash_of_orders(const std::string& name, const Words& more) {
    start(name, more);
    go_to(500);
    give({"goal", "bert", "-2.5", "-3"});
    give({"goal", "carl", "3", "-2.8", "3.2", "-2.8", "--speed", "0.3"});
    give({"say", "carl", "hello"});
    give({"place", "anna", "2.5", "0.5", "90"});
    go_to(600);
    give({"goal", "anna", "2.2", "-0.5"});
    give({"stop", "--robot", "bert"});
    go_to(700);
    give({"goal", "anna", "--cancel"});
    // A run in lock-step that is paused has not released it yet when it is asked to arm it.
    static_cast<void>(rave({"arm", "--robot", "bert", "--release"}));
    give({"resume"});
    const int code = wait_for(process_);
    process_ = -1;
    EXPECT_EQ(code, 0) << content_of(output_ + ".log");
    const auto result = nlohmann::json::parse(content_of(output_ + "/result.json"), nullptr, false);
    return result.is_object() && result["hash"].is_string() ? result["hash"].get<std::string>()
                                                            : "none";
  }

  TemporaryFolder folder_;
  std::string output_;
  pid_t process_ = -1;
};

TEST_F(OrdersOverHosts, TheHashIsThatOfOneProcessAndVerifyDoesThemAgain) {
  const std::string alone = hash_of_orders("alone", {});
  ASSERT_EQ(alone.size(), 16U) << alone;
  const Ended one = rave({"verify", output_});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  const std::string split = hash_of_orders(
      "split", {"--processes", "3", "--bus-tag", folder_.path().filename().string()});
  EXPECT_EQ(split, alone);
  for (const std::string host : {"host-1", "host-2", "host-3"}) {
    const Ended again = rave({"verify", output_ + "/hosts/" + host});
    EXPECT_EQ(again.exit_code, 0) << host << again.out << again.err;
    EXPECT_EQ(again.out.find("is refused here"), std::string::npos) << again.out;
  }
}

TEST_F(OrdersOverHosts, WhatAHostRefusesIsSaid) {
  start("split",
        {"--processes", "3", "--no-record", "--bus-tag", folder_.path().filename().string()});
  const Ended deaf = rave({"say", "bert", "hello"});
  EXPECT_EQ(deaf.exit_code, 1) << deaf.out;
  EXPECT_NE(deaf.err.find("its program takes no texts"), std::string::npos) << deaf.err;
  const Ended wall = rave({"goal", "anna", "0", "2"});
  EXPECT_EQ(wall.exit_code, 1) << wall.out;
  EXPECT_NE(wall.err.find("is inside the obstacle `wall`"), std::string::npos) << wall.err;
  const Ended post = rave({"place", "anna", "1", "1"});
  EXPECT_EQ(post.exit_code, 1) << post.out;
  EXPECT_NE(post.err.find("it would overlap `post`"), std::string::npos) << post.err;
  const Ended listed = rave({"ps", "--robots"});
  EXPECT_NE(listed.out.find("anna"), std::string::npos) << listed.out;
}

}  // namespace
}  // namespace rave::cli_test
