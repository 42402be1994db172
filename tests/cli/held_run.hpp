// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "process.hpp"

namespace rave::cli_test {

using Words = std::vector<std::string>;

/// A run of `orders.yaml` that starts paused and is held at steps of the test's choice.
class HeldRun : public ::testing::Test {
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
    Words words = {"run", scenario_,    "--output", output_,        "--pace",
                   pace_, "--duration", "9",        "--no-picture", "--paused"};
    words.insert(words.end(), more.begin(), more.end());
    process_ = start_rave(words, {"XDG_RUNTIME_DIR=" + folder_.path().string()}, output_ + ".log");
    ASSERT_GT(process_, 0);
    // Until all hosts are there, and the process that has the say has begun: it takes a pause.
    wait_until([&] {
      return rave({"edit", "list"}).exit_code == 0 && rave({"pause"}).exit_code == 0;
    });
    // `rave ps` says 0 s before step 0 and after it.
    give({"step"});
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
  /// Computes the steps up to this one; the run stays paused.
  void go_to(long target) {
    const long now = step();
    ASSERT_GE(now, 0) << rave({"ps"}).out;
    ASSERT_LT(now, target);
    ASSERT_EQ(rave({"step", "--count", std::to_string(target - now)}).exit_code, 0);
    wait_until([&] { return step() == target; });
  }
  void give(const Words& words) {
    const Ended ended = rave(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
  /// Goes on to the end of the run; its hash.
  std::string end() {
    give({"resume"});
    return hash_at_end();
  }
  /// The same of a run that shows its recording afterwards, until somebody quits.
  std::string end_of_show() {
    give({"resume"});
    wait_until(
        [&] { return content_of(output_ + ".log").find("Ctrl-C to quit") != std::string::npos; });
    ::kill(process_, SIGINT);
    return hash_at_end();
  }
  std::string hash_at_end() {
    const int code = wait_for(process_);
    process_ = -1;
    EXPECT_EQ(code, 0) << content_of(output_ + ".log");
    const auto result = nlohmann::json::parse(content_of(output_ + "/result.json"), nullptr, false);
    return result.is_object() && result["hash"].is_string() ? result["hash"].get<std::string>()
                                                            : "none";
  }
  /// Words that make three processes of it.
  [[nodiscard]] Words split() const {
    return {"--processes", "3", "--bus-tag", folder_.path().filename().string()};
  }
  /// Does its recordings again, of one process or of each host.
  void expect_verified(bool of_hosts) {
    const Words folders =
        of_hosts ? Words{"/hosts/host-1", "/hosts/host-2", "/hosts/host-3"} : Words{""};
    for (const std::string& folder : folders) {
      const Ended again = rave({"verify", output_ + folder});
      EXPECT_EQ(again.exit_code, 0) << folder << again.out << again.err;
      EXPECT_EQ(again.out.find("is refused here"), std::string::npos) << again.out;
    }
  }

  TemporaryFolder folder_;
  std::string scenario_ = "orders.yaml";
  std::string pace_ = "max";
  std::string output_;
  pid_t process_ = -1;
};

}  // namespace rave::cli_test
